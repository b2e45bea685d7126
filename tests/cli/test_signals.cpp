// SPDX-License-Identifier: LGPL-3.0-or-later
// Every signal that ends programs, in every phase of commands: nothing is left behind, and the program ends
// by the signal; a run that keeps checkpoints writes a last one.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "cli/run/stopped_run.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// All of which signal(7) says that they end a process, but those that cannot be handled, or mean a closed
/// pipe or the limit of file sizes.
std::vector<int> ending_signals() {
  std::vector<int> signals{SIGINT,    SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1,   SIGUSR2, SIGALRM,
                           SIGVTALRM, SIGPROF, SIGIO,  SIGPWR,  SIGABRT, SIGSTKFLT, SIGTRAP, SIGSYS};
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) signals.push_back(signal);
  return signals;
}

class Signals : public Stopped_run {
 protected:
  /// True once there is an unfinished file or folder.
  static bool has_begun(const fs::path& folder) {
    std::error_code gone;
    for (fs::recursive_directory_iterator entry(folder, gone), end; !gone && entry != end;
         entry.increment(gone))
      if (entry->path().filename().string().find(".tmp") != std::string::npos) return true;
    return false;
  }

  /// Sends the signal so long after the command has begun, and expects nothing of it, or all its results.
  /// Returns false if the command had done its work.
  bool stop(const std::vector<std::string>& arguments, int signal, int microseconds) const {
    const auto before = files();
    Clock::time_point time = Clock::time_point::max(), sent = time;
    const Outcome outcome = stop_program(arguments, path("."), signal, [&] {
      if (time == Clock::time_point::max() && has_begun(path(".")))
        time = Clock::now() + std::chrono::microseconds(microseconds);
      if (Clock::now() < time) return false;
      sent = Clock::now();
      return true;
    });
    if (outcome.exit_code == 0) return false;
    EXPECT_EQ(outcome.signal, signal) << arguments[0] << " " << outcome.err;
    EXPECT_LT(Clock::now() - sent, std::chrono::seconds(1)) << arguments[0];
    EXPECT_EQ(outcome.err, "") << arguments[0];
    if (files() == before && outcome.out.empty()) return true;
    const bool has_all = std::ranges::all_of(arguments, [&](const std::string& argument) {
      return !argument.starts_with("out") || exists(argument);
    });
    EXPECT_TRUE(has_all) << arguments[0] << ", signal " << signal << ": " << outcome.out;
    EXPECT_FALSE(has_begun(path("."))) << arguments[0] << ", signal " << signal;
    return false;
  }
};

TEST_F(Signals, LeaveNothingBehind) {
  succeed({"generate", "tets", "--cells", "8", "-o", "env.ovm"});
  std::string moves = "ax,ay,az,bx,by,bz\n";
  for (int i = 0; i < 20000; ++i) moves += "0.5,0.5,0.5,6.5,5.5,4.5\n";
  write("moves.csv", moves);
  write("scene.json",
        R"({"environment": {"generate": "hexes", "cells": 6}, "particles": [{"count": 3000, "speed": 9}],
                          "steps": 100000, "output": {"frame_every": 1}})");
  const std::vector<std::vector<std::string>> commands{
      {"generate", "hexes", "--cells", "30", "-o", "out.ovm"},
      {"import", "env.ovm", "-o", "out.cellwalk"},
      {"query", "env.ovm", "moves.csv", "-o", "out.csv", "--json", "out.json"},
      {"run", "scene.json", "-o", "out", "--json", "out.json"}};
  int members = 0, stopped = 0, microseconds = 0;
  for (const int signal : ending_signals())
    for (const auto& command : commands) {
      microseconds = (microseconds + 7919) % 40000;
      ++members;
      stopped += stop(command, signal, microseconds);
      ASSERT_FALSE(HasFailure());
    }
  EXPECT_GE(members, 150);
  EXPECT_GE(stopped, members / 2);
}

TEST_F(Signals, ThatComeBeforeThereAreResultsLeaveNothing) {
  write("scene.json",
        R"({"environment": {"generate": "hexes", "cells": 40}, "particles": [{"count": 3}], "steps": 9})");
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU, SIGQUIT}) {
    const Outcome outcome = stop_program({"run", "scene.json", "-o", "out", "--checkpoint-every", "2"},
                                         path("."), signal, [&] { return exists("out.part/lock"); });
    EXPECT_EQ(outcome.signal, signal);
    EXPECT_EQ(files(), std::vector<std::string>{"scene.json"});
  }
}

TEST_F(Signals, WriteALastCheckpoint) {
  write("scene.json", R"({"environment": {"generate": "tets", "cells": [3, 3, 3]}, "steps": 1000,
    "time_step": 0.02, "output": {"picture": false, "frame_every": 0},
    "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 6, "seed": 3, "speed": 4}]})");
  run_whole({"../scene.json"});
  int members = 0, stopped = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM,
                           SIGPROF, SIGIO, SIGPWR, SIGSTKFLT, SIGRTMIN, SIGRTMAX}) {
    fs::remove_all(parts());
    fs::create_directory(parts());
    std::vector<std::string> arguments = begin(1000000);
    arguments.insert(arguments.end(), {"--log", "log", "--log-interval", "0.001"});
    const Outcome outcome = stop_program(arguments, parts(), signal, [&] {
      const std::string log = fs::exists(parts() / "log") ? read_text(parts() / "log") : "";
      return log.find("\"done\":1") != std::string::npos;  // some step that begins with a 1
    });
    fs::remove(parts() / "log");
    ++members;
    if (fs::exists(parts() / "out")) continue;  // it was faster
    ++stopped;
    EXPECT_EQ(outcome.signal, signal);
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_GT(newest_step(parts()), 0);
    for (const std::string& name : names_below(parts()))
      EXPECT_TRUE(name.find("core") == std::string::npos && !name.ends_with(".tmp")) << name;
    expect_same(run_program(resume(), parts()));
  }
  EXPECT_EQ(members, 15);
  EXPECT_GE(stopped, 8);
}

TEST_F(Signals, OfBatchSystemsAreHandledWhateverTheLimits) {
  write("scene.json",
        R"({"environment": {"generate": "hexes", "cells": 3}, "particles": [{"count": 2000, "speed": 9}],
                          "steps": 10000000, "output": {"motion_every": 0, "picture": false}})");
  const int status =
      std::system(("cd '" + path("").string() + "' && (ulimit -c unlimited; ulimit -St 3; exec " +
                   CELLWALK_PROGRAM + " run scene.json -o out --checkpoint-every 10000000) 2> /dev/null")
                      .c_str());
  EXPECT_EQ(status >> 8, 128 + SIGXCPU);
  EXPECT_GT(newest_step(path(".")), 0);
  for (const std::string& name : files()) EXPECT_EQ(name.find("core"), std::string::npos);
}

}  // namespace
}  // namespace cellwalk::test
