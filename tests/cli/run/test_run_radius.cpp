// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes whose bodies and catheters have a radius.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
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

/// A body of a file has the radii of its edges, scaled as it is, or that of the scene, whatever the scale.
TEST_F(RunRadius, RadiiAreThoseOfTheFileUnlessTheSceneHasOne) {
  write("rod.csv", "x,y,z,radius\n0,0,0,0.0625\n0.5,0,0,0.125\n1,0,0,\n");
  const auto write_scene = [&](const std::string& keys) {
    write("s.json", R"({"environment": {"generate": "hexes", "cells": 4}, "steps": 1, "time_step": 1e-9,
      "output": {"picture": false},
      "bodies": [{"file": "rod.csv", "scale": 2, )" +
                        keys + "}]}");
  };
  const auto notes = [&] {
    succeed({"run", "s.json", "-o", "out", "--force"});
    return nlohmann::json::parse(text("out/run.json")).at("bodies").value("notes", nlohmann::json());
  };
  write_scene(R"("position": [1, 1, 0.25])");
  EXPECT_EQ(notes(), nlohmann::json());
  write_scene(R"("position": [1, 1, 0.2])");
  expect_failure(5, {"run", "s.json", "-o", "thick"},
                 {"s.json: bodies[0]: edge 1 of the body", "less than its radius 0.25"});
  write_scene(R"("position": [1, 1, 0.2], "edge_radius": 0.1875)");
  EXPECT_EQ(notes(), nlohmann::json{"bodies[0]: edge_radius 0.1875 instead of the radii of rod.csv"});
  write_scene(R"("position": [1, 1, 0], "edge_radius": 0)");
  EXPECT_EQ(notes(), nlohmann::json{"bodies[0]: edge_radius 0 instead of the radii of rod.csv"});
}

/// The facets that are nearer to the catheter than its radius stay open, and the table names what holds them.
TEST_F(RunRadius, AValveShutsRoundACatheter) {
  succeed({"run", CELLWALK_SHIPPED_DATA "/valve.json", "-o", "out", "--set", "output.picture=false", "--set",
           "particles=[]", "--steps", "170"});
  std::set<std::string> reasons;
  for (const auto& row : read_table(path("out/changes.csv")))
    if (row[3] == "refused") {
      EXPECT_EQ(row[9], "0") << "the catheter";
      EXPECT_EQ(row[11], "edge");
      reasons.insert(row[13]);
    }
  EXPECT_TRUE(reasons.contains("something is nearer to the facet than its radius"));
  EXPECT_TRUE(reasons.contains("something lies on both sides of the facet"));
}

TEST_F(RunRadius, ABeatingVesselPressesACatheter) {
  const std::string said =
      succeed({"run", CELLWALK_SHIPPED_DATA "/pulse.json", "-o", "out", "--set", "output.picture=false",
               "--set", "catheter.radius=0.15", "--set", "particles=[]", "--steps", "60"});
  EXPECT_NE(said.find("is nearer to one than its radius"), std::string::npos) << said;
  const auto walls = nlohmann::json::parse(text("out/run.json")).at("walls");
  EXPECT_GT(walls.at("contacts").get<int>(), 10) << walls;
}

TEST_F(RunRadius, ARopeFallsOverAStep) {
  const std::string said =
      succeed({"run", CELLWALK_SHIPPED_DATA "/rope.json", "-o", "out", "--set", "output.picture=false"});
  EXPECT_NE(said.find("is nearer to one than its radius"), std::string::npos) << said;
  // Contacts on the rounded edge of the step have normals between those of its sides.
  int on_the_edge = 0;
  const auto contacts = read_table(path("out/contacts.csv"));
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(contacts[0], name) - contacts[0].begin());
  };
  const std::size_t nx = column("nx"), nz = column("nz");
  for (std::size_t i = 1; i < contacts.size(); ++i)
    on_the_edge += std::stod(contacts[i][nx]) > 0.1 && std::stod(contacts[i][nz]) > 0.1;
  EXPECT_GT(on_the_edge, 10);
}

}  // namespace
}  // namespace cellwalk::test
