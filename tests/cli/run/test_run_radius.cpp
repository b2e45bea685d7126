// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes whose bodies and catheters have a radius.
#include <string>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

constexpr const char* thick_scene = R"({
  "environment": {"generate": "hexes", "cells": 4},
  "bodies": [{"shape": "polyline", "points": [[0, 0, 0], [1, 0, 0]], "edge_radius": 0.25,
              "position": [1, 1, 1], "velocity": [0, 0, -9]}],
  "catheter": {"path": [[3, 3, 0.5], [3, 3, 3.5]], "spacing": 0.5, "particles": 8, "radius": 0.375},
  "steps": 20, "time_step": 0.01, "output": {"frame_every": 20, "picture": false}
})";

class RunRadius : public Program {};

TEST_F(RunRadius, ABodyAndACatheterKeepTheirDistance) {
  write("s.json", thick_scene);
  const std::string said = succeed({"run", "s.json", "-o", "out"});
  EXPECT_NE(said.find("no edge crosses a wall or is nearer to one than its radius"), std::string::npos)
      << said;
  EXPECT_NE(text("out/frames/bodies_00000.vtu").find("\"radius\""), std::string::npos);
  // The rod falls on the floor, at the distance of its radius.
  const auto contacts = read_table(path("out/contacts.csv"));
  ASSERT_GT(contacts.size(), 1u);
}

}  // namespace
}  // namespace cellwalk::test
