// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs of every kind of scene that are killed at any moment and go on from their checkpoints leave the same
// bytes as runs that are not.
#include <cellwalk/internal/kernel/random.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "cli/run/block_scene.h"
#include "cli/run/stopped_run.h"

namespace cellwalk::test {
namespace {

using Clock = std::chrono::steady_clock;

const std::string data = CELLWALK_SHIPPED_DATA;

/// Stands for a scene that the test writes.
const std::string block = "../scene.json";

struct Kind {
  const char* name;
  std::vector<std::string> arguments;  ///< of `cellwalk run`
  int steps, every;
  std::vector<std::string> again{};  ///< those that `--resume` is to be given, too
};

const std::vector<Kind> kinds{
    {"bodies", {data + "/bodies.json", "--record", "b.trace"}, 60, 7, {"--record", "b.trace"}},
    {"bodies_2d", {data + "/bodies_2d.json"}, 90, 10},
    {"rooms", {data + "/rooms.json", "--set", "catheter.particles=60"}, 90, 10},
    {"catheter",
     {data + "/catheter.json", "--json", "report.json", "--record", "c.trace"},
     60,
     7,
     {"--json", "report.json", "--record", "c.trace"}},
    {"thin_catheter", {data + "/catheter.json", "--set", "catheter.radius=0"}, 60, 7},
    {"inlet_to_outlet", {data + "/inlet_to_outlet.json"}, 60, 7},
    {"soft",
     {data + "/soft.json", "--sweep", "faces", "--set", "bodies[0].count=2", "--set", "bodies[1].count=3"},
     30,
     4},
    {"pulse", {data + "/pulse.json"}, 40, 5},
    {"soft_vessel", {data + "/soft_vessel.json"}, 60, 7},
    {"valve", {data + "/valve.json", "--set", "changes[1].step=20", "--set", "changes[2].step=40"}, 60, 7},
    {"excavation",
     {data + "/excavation.json", "--set", "changes[1].step=40", "--set", "changes[2].step=60", "--set",
      "changes[0].until=30"},
     80,
     7},
    {"cut", {data + "/cut.json", "--set", "changes[1].step=12"}, 36, 4},
    {"suture", {data + "/suture.json", "--set", "changes[1].step=8", "--set", "changes[2].step=20"}, 32, 4},
    {"motion", {block}, block_steps, 4},
    {"relax", {block, "--set", "walls.relax={}"}, block_steps, 4},
};

class Stops : public Stopped_run, public testing::WithParamInterface<Kind> {
 protected:
  /// Runs a part of the run, and kills it at a time, or some time after it has come to a step.
  Outcome part(bool kills) {
    const Kind& kind = GetParam();
    const std::int64_t known = newest_step(parts()), last = kind.steps - kind.every;
    resumed_ += known >= 0;
    step_ = std::max(step_, known);
    const auto microseconds = [&](std::uint64_t most) {
      return std::chrono::microseconds(1 + random_.below(most));
    };
    constexpr std::uint64_t most_after_step = 30000;
    const bool by_time = random_.below(3) == 0;
    const std::int64_t aim = std::min<std::int64_t>(
        last, known + 1 + static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(kind.steps))));
    const auto delay = microseconds(by_time ? whole_ : most_after_step);
    Clock::time_point time = by_time ? Clock::now() + delay : Clock::time_point::max();
    return stop_program(known < 0 ? begin(kind.every) : resume_again(), parts(), SIGKILL, [&] {
      if (time == Clock::time_point::max() && newest_step(parts()) >= aim) time = Clock::now() + delay;
      return kills && Clock::now() >= time;
    });
  }

  static std::vector<std::string> resume_again() {
    std::vector<std::string> arguments = resume();
    arguments.insert(arguments.end(), GetParam().again.begin(), GetParam().again.end());
    return arguments;
  }

  /// Runs it to its end, and kills it so many times at most. Returns how many times it was.
  int run_parts(int most) {
    std::filesystem::remove_all(parts());
    std::filesystem::create_directory(parts());
    for (int killed = 0;; ++killed) {
      const Outcome outcome = part(killed < most);
      if (outcome.exit_code >= 0) {
        if (outcome.out.find("the run had ended") == std::string::npos)
          expect_same(outcome);
        else  // it was killed when only its checkpoints were left to be removed
          expect_same_files(parts(), path("whole"));
        return killed;
      }
      if (!std::filesystem::exists(parts() / "out")) continue;
      const Outcome last =
          run_program(resume_again(), parts());  // it was killed when its results were in place
      EXPECT_EQ(last.exit_code, 0) << last.err;
      expect_same_files(parts(), path("whole"));
      return killed + 1;
    }
  }

  Random random_{1};
  std::uint64_t whole_ = 0;  ///< microseconds of the run that is not stopped
  int resumed_ = 0;
  std::int64_t step_ = -1;  ///< the last from which a part went on
};

TEST_P(Stops, LeaveTheSameBytes) {
  const Kind& kind = GetParam();
  if (const char* const seed = std::getenv("CELLWALK_TEST_SEED")) random_ = Random(std::stoull(seed));
  std::vector<std::string> arguments = kind.arguments;
  arguments.insert(arguments.end(), {"--steps", std::to_string(kind.steps)});
  if (arguments.front() == block) write_block_scene(path("."), 3);
  const auto began = Clock::now();
  run_whole(arguments);
  if (HasFatalFailure()) return;
  whole_ = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - began).count());
  int killed = 0;
  for (const int wanted = scaled(1); !HasFailure() && (killed < wanted || step_ <= 0);)
    killed += run_parts(1 + static_cast<int>(random_.below(static_cast<std::uint64_t>(std::min(wanted, 4)))));
  std::cout << kind.name << ": " << killed << " kills, " << resumed_ << " parts went on, the last from step "
            << step_ << "\n";
}

INSTANTIATE_TEST_SUITE_P(OfScenes, Stops, testing::ValuesIn(kinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace cellwalk::test
