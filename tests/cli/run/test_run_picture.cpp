// SPDX-License-Identifier: LGPL-3.0-or-later
// The picture of a run takes bounded memory and time, and never costs the run.
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

constexpr long most_kilobytes = 300 * 1000;  // beyond those of the run

/// The most memory that any program took which this test has started.
long peak_kilobytes() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return used.ru_maxrss;
}

class RunPicture : public Program {
 protected:
  /// Runs a scene without its picture, then with it. Returns the summary of the latter.
  std::string draw(const std::string& scene) {
    write("s.json", scene);
    succeed({"run", "s.json", "-o", "without", "--set", "output.picture=false"});
    const long before = peak_kilobytes();
    std::string said = succeed({"run", "s.json", "-o", "with"});
    EXPECT_LE(peak_kilobytes() - before, most_kilobytes);
    EXPECT_GT(text("with/picture.png").size(), 20000u);
    return said;
  }
};

TEST_F(RunPicture, OfThousandsOfBodiesIsSmall) {
  draw(R"({"environment": {"generate": "hexes", "cells": 20, "solid": 0.1}, "steps": 2, "time_step": 0.02,
    "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 2000, "speed": 3,
                "material": {"model": "shape_matching", "mode": "linear", "stiffness": 1}}],
    "output": {"frame_every": 0, "motion_every": 0, "picture": true}})");
}

TEST_F(RunPicture, OfManyParticlesIsSmall) {
  draw(R"({"environment": {"generate": "hexes", "cells": 12, "solid": 0.1}, "steps": 4, "time_step": 0.2,
    "particles": [{"count": 30000, "speed": 9}],
    "output": {"frame_every": 0, "motion_every": 0, "picture": true}})");
}

TEST_F(RunPicture, InThePlaneIsSmall) {
  draw(R"({"dimension": 2, "environment": {"generate": "squares", "cells": 300, "solid": 0.2}, "steps": 3,
    "time_step": 0.2, "particles": [{"count": 40000, "speed": 9}],
    "output": {"frame_every": 0, "motion_every": 0, "picture": true}})");
}

// Where not even memory for the pixels is left.
TEST_F(RunPicture, IsMissingFromARunThatCannotDrawIt) {
  write("s.json", R"({"environment": {"generate": "hexes", "cells": 2}, "steps": 2,
    "particles": [{"count": 9}], "output": {"picture": {"width": 16384, "height": 16384}}})");
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  rlimit small = before;
  small.rlim_cur = rlim_t{800} * 1000 * 1000;
  setrlimit(RLIMIT_AS, &small);
  const Outcome outcome = run({"run", "s.json", "-o", "out", "--threads", "1"});
  setrlimit(RLIMIT_AS, &before);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("no picture  out of memory"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("picture.png"), std::string::npos) << outcome.out;
  EXPECT_NE(read_text(path("out/run.json")).find("\"no_picture\": \"out of memory\""), std::string::npos);
  EXPECT_TRUE(exists("out/contacts.csv"));
  EXPECT_FALSE(exists("out/picture.png"));
}

TEST_F(RunPicture, IsInterruptedAtOnce) {
  write("s.json", R"({"environment": {"generate": "hexes", "cells": 2}, "steps": 2,
    "particles": [{"count": 9}], "output": {"picture": {"width": 10000, "height": 10000}}})");
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Clock::time_point sent;
  const auto is_time = [&] {
    sent = Clock::now();
    return sent - start > std::chrono::seconds(2);  // steps take a hundredth of that, the picture ten times
  };
  const Outcome outcome = stop_program({"run", "s.json", "-o", "out"}, path("."), SIGINT, is_time);
  EXPECT_EQ(outcome.exit_code, -1) << outcome.out << outcome.err;
  EXPECT_LT(Clock::now() - sent, 3 * (sent - start)) << "the picture would take ten times as long";
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace cellwalk::test
