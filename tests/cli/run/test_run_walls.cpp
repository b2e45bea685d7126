// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes with walls that move, as `cellwalk run` runs, reports and refuses them.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// A room of 4 x 3 x 3 unit cells that beats, with particles and a catheter.
constexpr const char* beating_room = R"({
  "environment": {"generate": "hexes", "cells": [4, 3, 3]},
  "particles": [{"count": 40, "seed": 3, "speed": 4}],
  "catheter": {"path": [[0.5, 1.5, 1.4], [9, 1.5, 1.6]], "spacing": 0.3, "particles": 12},
  "walls": {"pulsation": {"amplitude": 0.2, "period": 1, "wave": [4, 0, 0]}},
  "time_step": 0.05, "steps": 40, "output": {"frame_every": 20}
})";

class RunWalls : public Program {
 protected:
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }
  /// A scene of the plane whose walls follow moves.csv: nine squares, point x + 4 y in (x,y).
  void write_table_scene(const std::string& moves, const std::string& particle) const {
    write("moves.csv", moves);
    write("scene.json", R"({"dimension": 2, "environment": {"generate": "squares", "cells": 3},
      "particles": [{"position": )" +
                            particle + R"(}], "walls": {"motion": "moves.csv", "at_contact": "stop"},
      "time_step": 1, "steps": 4})");
  }
};

TEST_F(RunWalls, BeatAndSayWhatTheyMet) {
  write("room.json", beating_room);
  const std::string said = succeed({"run", "room.json", "-o", "out"});
  EXPECT_NE(said.find("moves of points"), std::string::npos) << said;
  EXPECT_NE(said.find("walls.csv"), std::string::npos) << said;
  const json walls = report("out")["walls"];
  const auto rows = read_table(path("out/walls.csv"));
  ASSERT_GT(rows.size(), 10u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"step", "vertex", "time", "x", "y", "z", "kind", "nx", "ny",
                                               "nz", "cell", "body", "particle", "feature", "number"}));
  EXPECT_EQ(walls["contacts"], rows.size() - 1);
  EXPECT_GT(walls["counts"]["pushes"], 10u);
  std::uint64_t ends = 0;
  for (const auto& [name, count] : walls["status"].items()) ends += count.get<std::uint64_t>();
  EXPECT_EQ(ends, walls["moves"]);
  EXPECT_GT(walls["status"]["reached"].get<double>(), 0.99 * walls["moves"].get<double>());
  std::set<std::string> met;
  double last = 1;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    ASSERT_EQ(row.size(), 15u);
    EXPECT_GE(std::stod(row[0]), last);
    last = std::stod(row[0]);
    EXPECT_NEAR(std::hypot(std::stod(row[7]), std::stod(row[8]), std::stod(row[9])), 1, 1e-12);
    EXPECT_NE(row[11].empty(), row[12].empty()) << "a body or a particle";
    EXPECT_EQ(row[11].empty(), row[13].empty() && row[14].empty());
    met.insert(row[11].empty() ? "particle" : "body " + row[11]);
  }
  EXPECT_TRUE(met.contains("particle"));
  // Frames show the walls where they are.
  EXPECT_FALSE(exists("out/walls.vtu"));
  ASSERT_TRUE(exists("out/frames/walls_00000.vtu") && exists("out/frames/walls_00002.vtu"));
  EXPECT_NE(text("out/frames/walls_00000.vtu"), text("out/frames/walls_00001.vtu"));
  EXPECT_NE(text("out/run.pvd").find("frames/walls_00001.vtu"), std::string::npos);
  // Again it is the same, on any number of threads.
  succeed({"run", "room.json", "-o", "again", "--threads", "1"});
  for (const char* file : {"walls.csv", "contacts.csv", "run.json", "frames/walls_00002.vtu"})
    EXPECT_EQ(text(std::string("out/") + file), text(std::string("again/") + file)) << file;
}

TEST_F(RunWalls, FollowATable) {
  // The particle lies in the way of the lower left corner in step 2. It stops before it, and tries again.
  write_table_scene("step,point,x,y\n3,5,1.25,1\n2,0,0.5,0.5\n1,15,3.5,3.5\n", "[0.25, 0.25]");
  const std::string said = succeed({"run", "scene.json", "-o", "out"});
  const json walls = report("out")["walls"];
  EXPECT_EQ(walls["status"]["reached"], 2) << "the other two are reached at once";
  EXPECT_EQ(walls["moves"], 5) << "and the corner is moved in steps 2, 3 and 4";
  EXPECT_EQ(walls["counts"]["pushes"], 0);
  const auto rows = read_table(path("out/walls.csv"));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][1], "0") << "the vertex that moves";
    EXPECT_EQ(rows[i][5], "") << "no z in the plane";
  }
}

TEST_F(RunWalls, YieldToWhatPressesThem) {
  write("room.json", R"({
    "environment": {"generate": "hexes", "cells": [4, 3, 3]},
    "catheter": {"path": [[0.5, 1.5, 1.4], [9, 1.5, 1.6]], "spacing": 0.3, "particles": 20, "stiffness": 1},
    "walls": {"soft": {"compliance": 4}, "at_contact": "stop"}, "time_step": 0.05, "steps": 40})");
  const std::string said = succeed({"run", "room.json", "-o", "out"});
  EXPECT_NE(said.find("they yield by up to"), std::string::npos) << said;
  EXPECT_NE(said.find("forces.csv"), std::string::npos) << said;
  const auto rows = read_table(path("out/forces.csv"));
  ASSERT_EQ(rows.size(), 41u) << "one a step";
  EXPECT_EQ(rows[0], (std::vector<std::string>{"step", "vertices", "largest_yield", "force"}));
  double most = 0, force = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    most = std::max(most, std::stod(rows[i][2]));
    force = std::max(force, std::stod(rows[i][3]));
  }
  EXPECT_GT(most, 0.01);
  const json yielded = report("out")["walls"]["soft"];
  EXPECT_EQ(yielded["largest_yield"], most);
  EXPECT_EQ(yielded["largest_force"], force);
}

TEST_F(RunWalls, AreRefusedWithFileAndLine) {
  write_table_scene("step,point,x,y\n1,5,1,1\n1,99,1,1\n", "[0.5, 0.5]");
  expect_failure(3, {"run", "scene.json", "-o", "out"}, {"moves.csv:3: there is no point 99"});
  write_table_scene("step,point,x,y\n0,5,1,1\n", "[0.5, 0.5]");
  expect_failure(3, {"run", "scene.json", "-o", "out"},
                 {"moves.csv:2: there is no step 0: steps are counted from 1"});
  write_table_scene("step,point,x,y\n2,5,1,1\n2,5,1.25,1\n", "[0.5, 0.5]");
  expect_failure(3, {"run", "scene.json", "-o", "out"},
                 {"moves.csv:3: point 5 has two places in step 2: give one"});
  write_table_scene("point,x,y\n5,1,1\n", "[0.5, 0.5]");
  expect_failure(3, {"run", "scene.json", "-o", "out"}, {"moves.csv: has no column 'step'"});
  write("room.json", beating_room);
  expect_failure(3, {"run", "room.json", "-o", "out", "--record", "trace", "--set", "particles=[]"},
                 {"room.json: walls: a trace has walls that stand still: leave them out"});
}

}  // namespace
}  // namespace cellwalk::test
