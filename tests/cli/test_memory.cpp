// SPDX-License-Identifier: LGPL-3.0-or-later
// Memory that is used up at any moment, once or for good: a command succeeds with the same bytes, or says so
// in a line and leaves nothing behind.
#include <cellwalk/internal/kernel/random.h>

#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/stopped_run.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

/// A variable of the environment, handed on to programs during its lifetime.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

class Little_memory : public Program {
 protected:
  using Contents = std::map<std::string, std::string>;

  void SetUp() override {
    succeed({"generate", "tets", "--cells", "2", "-o", "env.ovm"});
    write("moves.csv", "ax,ay,az,bx,by,bz\n0.5,0.5,0.5,1.5,1.4,0.5\n0.5,0.5,0.5,2.5,0.5,0.5\n");
    write("points.csv", "point,x,y,z\n0,0.01,0.01,0.01\n");
    write("scene.json", R"({"environment": "env.ovm", "particles": [{"count": 20, "speed": 9}], "steps": 24,
      "bodies": [{"shape": "hexahedron", "side": 0.2, "count": 2, "seed": 3, "speed": 4}],
      "output": {"frame_every": 12, "picture": {"width": 16, "height": 16}}})");
    write("pulse.json",
          R"({"environment": {"generate": "tets", "cells": [2, 2, 2]}, "steps": 4, "time_step": 0.02,
      "bodies": [{"shape": "hexahedron", "side": 0.2, "count": 1, "seed": 3, "speed": 4}],
      "walls": {"pulsation": {"amplitude": 0.02, "period": 0.4}}, "output": {"picture": false}})");
  }
  Contents contents() const {
    Contents all;
    for (const std::string& name : files())
      all[name] = fs::is_regular_file(path(name)) ? text(name) : "folder";
    return all;
  }

  std::map<std::string, int> said_;  ///< each message, without what differs
  int runs_ = 0, refused_ = 0, kept_ = 0;

  Outcome run_with_little(const std::vector<std::string>& command, const std::string& at, bool once) const {
    const Variable library("LD_PRELOAD", CELLWALK_LITTLE_MEMORY), number("CELLWALK_FAILS_AT", at);
    std::optional<Variable> only;
    if (once) only.emplace("CELLWALK_FAILS_ONCE", "1");
    return run(command);
  }

  /// Runs a command with memory that is used up at so many allocations of it.
  void try_out(const std::vector<std::string>& command, int limits, std::uint64_t seed) {
    const Contents before = contents();
    long count = 0;
    {
      const Variable library("LD_PRELOAD", CELLWALK_LITTLE_MEMORY), file("CELLWALK_COUNTS_IN", path("count"));
      ASSERT_EQ(run(command).exit_code, 0);
      count = std::stol(text("count"));
      fs::remove(path("count"));
    }
    ASSERT_GT(count, 1000) << "the library was not loaded";
    const Contents after = contents();
    const auto clean = [&] {
      for (const auto& [name, content] : contents())
        if (!before.contains(name)) fs::remove_all(path(name));
    };
    clean();
    const Outcome whole = run(command);
    clean();
    Random random(seed);
    for (int i = 0; i < limits; ++i) {
      // Half of them at the begin, where there are more different places; the others one in each part of the
      // run, so that some come after a checkpoint whatever the draw.
      const long part = i / 2, parts = (limits + 1) / 2;
      const long first = i % 2 == 0 ? count * part / parts : 0;
      const long last = i % 2 == 0 ? count * (part + 1) / parts : std::min(count, 3000L);
      const auto later = static_cast<long>(random.below(static_cast<std::uint64_t>(last - first)));
      const std::string at = std::to_string(first + 1 + later);
      const bool once = i % 3 == 0;
      const Outcome outcome = run_with_little(command, at, once);
      ++runs_;
      SCOPED_TRACE(command[0] + " " + command[1] + ", allocation " + at +
                   (once ? ", once" : " and all later ones") + ", exit code " +
                   std::to_string(outcome.exit_code));
      if (outcome.exit_code == 0) {
        if (outcome.out.find("no picture") == std::string::npos) {  // a run goes without one
          EXPECT_EQ(outcome.out, whole.out);
          EXPECT_TRUE(contents() == after);
        }
      } else {
        ++refused_;
        EXPECT_EQ(outcome.signal, 0);
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with("cellwalk: ")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("memory"), std::string::npos) << outcome.err;
        if (newest_step(path(".")) >= 0) {  // a run that goes on once there is memory
          EXPECT_EQ(run({"run", "--resume", "out"}).exit_code, 0);
          ++kept_;
        } else {
          EXPECT_TRUE(contents() == before);
        }
        ++said_[outcome.err];
      }
      clean();
    }
  }
};

TEST_F(Little_memory, IsSaidInALine) {
  const std::vector<std::vector<std::string>> commands{
      {"import", "env.ovm", "-o", "out.cellwalk", "--json", "out.json"},
      {"check", "env.ovm", "--json", "out.json"},
      {"generate", "hexes", "--cells", "2", "-o", "out.ovm"},
      {"query", "env.ovm", "moves.csv", "-o", "out.csv"},
      {"deform", "env.ovm", "points.csv", "-o", "out.ovm"},
      {"run", "scene.json", "-o", "out"},
      {"run", "scene.json", "-o", "out", "--checkpoint-every", "2", "--json", "out.json"},
      {"run", "pulse.json", "-o", "out"}};
  std::uint64_t seed = 1;
  for (const auto& command : commands) try_out(command, scaled(20), seed++);
  for (const auto& [message, count] : said_) std::cout << count << " times " << message;
  EXPECT_GE(runs_, scaled(20) * static_cast<int>(commands.size()));
  EXPECT_GE(refused_, runs_ / 2);
  EXPECT_GE(kept_, 1);
}

}  // namespace
}  // namespace cellwalk::test
