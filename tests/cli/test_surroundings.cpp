// SPDX-License-Identifier: LGPL-3.0-or-later
// What whoever starts the program hands on to it: signals that are ignored, streams that are closed, and
// names of any bytes.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class Surroundings : public Program {
 protected:
  /// True once there is a file whose path holds a text.
  bool has_begun(const std::string& part) const {
    std::error_code gone;
    for (fs::recursive_directory_iterator entry(path("."), gone), end; !gone && entry != end;
         entry.increment(gone))
      if (fs::relative(entry->path(), path("."), gone).string().find(part) != std::string::npos) return true;
    return false;
  }

  /// The exit code of the program with its streams redirected as a shell does it.
  int in_shell(const std::string& command) const {
    return std::system(("cd '" + path("").string() + "' && " CELLWALK_PROGRAM " " + command).c_str()) >> 8;
  }

  /// Sends a signal once a file is there, and expects that the command goes on.
  void expect_ignored(const std::vector<std::string>& arguments, int signal, const std::string& part) {
    bool is_sent = false;
    const Outcome outcome = stop_program(
        arguments, path("."), signal, [&] { return is_sent = has_begun(part); }, 0, true);
    EXPECT_TRUE(is_sent);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(Surroundings, SignalsThatAreIgnoredStayIgnored) {
  write(
      "scene.json",
      R"({"environment": {"generate": "hexes", "cells": 5}, "particles": [{"count": 2000}], "steps": 300})");
  for (const int signal : {SIGHUP, SIGINT}) {
    expect_ignored({"generate", "hexes", "--cells", "20", "-o", "env.ovm"}, signal, ".env.ovm.");
    expect_ignored({"run", "scene.json", "-o", "out", "--force"}, signal, ".contacts.csv.");
  }
}

TEST_F(Surroundings, ASignalEndsThePlacingOfBodies) {
  write("scene.json",
        R"({"environment": {"generate": "hexes", "cells": 30}, "steps": 1,
            "bodies": [{"shape": "hexahedron", "side": 0.01, "count": 100000}]})");
  const auto before = files();
  Clock::time_point sent = Clock::time_point::max(), ready = sent;
  const Outcome outcome = stop_program({"run", "scene.json", "-o", "out"}, path("."), SIGTERM, [&] {
    const auto now = Clock::now();
    constexpr std::chrono::milliseconds until_placing{700};
    if (ready == Clock::time_point::max() && has_begun("out.tmp-")) ready = now + until_placing;
    if (now < ready) return false;
    sent = now;
    return true;
  });
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_LT(Clock::now() - sent, std::chrono::seconds(1)) << "all bodies take several";
  EXPECT_EQ(files(), before);
}

TEST_F(Surroundings, NoFileTakesThePlaceOfAClosedStream) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  EXPECT_EQ(in_shell("check env.ovm --log log >&- 2> err"), 1);
  EXPECT_EQ(text("err"), "cellwalk: standard output cannot be written\n");
  EXPECT_EQ(text("log").find("certified"), std::string::npos);
  EXPECT_EQ(in_shell("check env.ovm --json report.json >&- 2> err"), 1);
  EXPECT_FALSE(exists("report.json"));
  write("moves.csv", "ax,ay,bx,by\n0.5,0.5,1.5,x\n");
  fs::remove(path("log"));
  EXPECT_EQ(in_shell("query env.ovm moves.csv -o a.csv --log log > out 2>&-"), 0);
  EXPECT_EQ(text("log").find("cellwalk:"), std::string::npos) << text("log");
  EXPECT_EQ(in_shell("query env.ovm moves.csv -o b.csv <&- > out 2> err"), 0);
  EXPECT_EQ(text("a.csv"), text("b.csv"));
}

TEST_F(Surroundings, ErrorsShowNamesInOneLineWithoutControlCharacters) {
  succeed({"generate", "squares", "--cells", "2", "-o", "env.ovm"});
  expect_failure(1, {"check", "env.ovm", "--json", "no\nthere\x1b[31m/o.json"},
                 {"cellwalk: no\\nthere\\x1b[31m/o.json: cannot be written: check that"});
  expect_failure(2, {"check", "env.ovm", "--\x1b[2J\nx"}, {"--\\x1b[2J\\nx"});
  write("m\x1b\n.csv", "ax,ay,bx,by\n0.5,0.5,1.5,x\n");
  const Outcome outcome = run({"query", "env.ovm", "m\x1b\n.csv", "-o", "a.csv"});
  EXPECT_TRUE(outcome.err.starts_with("cellwalk: m\\x1b\\n.csv:2: by: 'x' is not a number")) << outcome.err;
}

}  // namespace
}  // namespace cellwalk::test
