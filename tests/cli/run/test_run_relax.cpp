// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that go so far that cells before them would be flat, and cells that are relaxed before.
#include <nlohmann/json.hpp>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class RunRelax : public Program {
 protected:
  static constexpr int length_of_grid = 9, width = 7, steps = 40;
  static constexpr double way = 0.1;  // of a step

  /// A solid block of one cube at x = 2 goes through a grid of split cubes, to x = 6.
  void write_scene(int dimension) const {
    const bool in_space = dimension == 3;
    std::ostringstream table;
    table << (in_space ? "step,point,x,y,z\n" : "step,point,x,y\n");
    for (int step = 1; step <= steps; ++step)
      for (int corner = 0; corner < 1 << dimension; ++corner) {
        const int x = 2 + corner % 2, y = 3 + corner / 2 % 2, z = in_space ? 3 + corner / 4 : 0;
        table << step << ',' << x + (length_of_grid + 1) * (y + (width + 1) * z) << ',' << x + way * step
              << ',' << y;
        if (in_space) table << ',' << z;
        table << '\n';
      }
    write("moves.csv", table.str());
    const json low = in_space ? json{2, 3, 3} : json{2, 3}, end = in_space ? json{3, 4, 4} : json{3, 4};
    json cells{length_of_grid, width}, particles = json::array();
    if (in_space) cells.push_back(width);
    for (int i = 0; i < 12; ++i) {
      json place{0.37 + 0.7 * i, 3.2 + 0.05 * i};
      if (in_space) place.push_back(3.45);
      if (i != 3) particles.push_back({{"position", place}});  // the block is there
    }
    const json scene{{"dimension", dimension},
                     {"environment", {{"generate", in_space ? "tets" : "triangles"}, {"cells", cells}}},
                     {"particles", particles},
                     {"changes", json::array({{{"step", 1}, {"fill", {{"box", {low, end}}}}}})},
                     {"walls", {{"motion", "moves.csv"}}},
                     {"time_step", 0.01},
                     {"steps", steps},
                     {"output", {{"frame_every", 10}}}};
    write("scene.json", scene.dump());
  }
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }

  void go_far(int dimension) const {
    write_scene(dimension);
    const std::size_t points = std::size_t{1} << dimension;
    const std::string without = succeed({"run", "scene.json", "-o", "without"});
    EXPECT_EQ(without.find("made cells better"), std::string::npos);
    json walls = report("without")["walls"];
    EXPECT_GT(walls["status"]["cell"], steps * points / 2) << "they lock";
    EXPECT_FALSE(walls.contains("relaxed"));

    const std::string said = succeed({"run", "scene.json", "-o", "with", "--set", "walls.relax={}"});
    EXPECT_NE(said.find("made cells better"), std::string::npos) << said;
    const json run = report("with");
    walls = run["walls"];
    EXPECT_EQ(walls["moves"], steps * points);
    EXPECT_EQ(walls["status"]["cell"], 0) << walls.dump();
    EXPECT_GE(walls["status"]["reached"], steps * points - 2) << "the others at a particle: " << walls.dump();
    EXPECT_TRUE(run["validated"].get<bool>());
    EXPECT_GT(walls["contacts"], 0) << "particles are pushed";
    const json& relaxed = walls["relaxed"];
    for (const char* kind : {"smoothed", "flipped"}) EXPECT_GT(relaxed[kind], 0) << relaxed.dump();
    if (dimension == 3) {
      EXPECT_GT(relaxed["edges_removed"], 0);
    }
    EXPECT_NE(text("with/frames/walls_00002.vtu"), text("with/frames/walls_00003.vtu"));

    succeed({"run", "scene.json", "-o", "again", "--set", "walls.relax={}", "--threads", "1"});
    for (const char* file : {"walls.csv", "run.json", "contacts.csv", "frames/walls_00004.vtu", "motion.gz"})
      EXPECT_EQ(text(std::string("with/") + file), text(std::string("again/") + file)) << file;
  }
};

TEST_F(RunRelax, LetsWallsGoFarInThePlane) { go_far(2); }
TEST_F(RunRelax, LetsWallsGoFarInSpace) { go_far(3); }

TEST_F(RunRelax, IsBounded) {
  write_scene(2);
  succeed({"run", "scene.json", "-o", "out", "--set",
           R"(walls.relax={"operations": 1, "rounds": 1, "tries": 1, "rings": 1})"});
  const json relaxed = report("out")["walls"]["relaxed"];
  int sum = 0;
  for (const auto& [kind, count] : relaxed.items()) sum += count.get<int>();
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, steps) << "one a step";
}

}  // namespace
}  // namespace cellwalk::test
