// SPDX-License-Identifier: LGPL-3.0-or-later
// A run of a small scene that is stopped, and what the program says about the folder that it leaves.
#ifndef CELLWALK_TESTS_CLI_RUN_STOPPED_BOXES_H
#define CELLWALK_TESTS_CLI_RUN_STOPPED_BOXES_H

#include <csignal>
#include <string>
#include <vector>

#include "cli/run/stopped_run.h"

namespace cellwalk::test {

class Stopped_boxes : public Stopped_run {
 protected:
  void SetUp() override {
    write("scene.json", R"({
      "environment": {"generate": "tets", "cells": [3, 3, 3]},
      "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 6, "seed": 3, "speed": 4}],
      "time_step": 0.02, "steps": 160, "output": {"frame_every": 40}
    })");
    run_whole({"../scene.json"});
  }
  std::filesystem::path out() const { return parts() / "out"; }
  std::filesystem::path part() const { return parts() / "out.part"; }

  void stop_at(std::int64_t step, const std::vector<std::string>& arguments) const {
    const Outcome stopped =
        stop_program(arguments, parts(), SIGKILL, [&] { return newest_step(parts()) >= step; });
    ASSERT_EQ(stopped.exit_code, -1) << "it ended before: " << stopped.err;
  }
  void expect_refusal(const std::vector<std::string>& arguments, int exit_code,
                      const std::string& message) const {
    const Outcome refused = run_program(arguments, parts());
    EXPECT_EQ(refused.exit_code, exit_code);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(refused.err, "cellwalk: " + message + "\n");
  }
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_RUN_STOPPED_BOXES_H
