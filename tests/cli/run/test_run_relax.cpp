// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that go so far that cells before them would be flat, and cells that are relaxed before.
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "cli/program.h"
#include "cli/run/block_scene.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

class RunRelax : public Program {
 protected:
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }

  void go_far(int dimension) const {
    write_block_scene(path("."), dimension);
    constexpr int steps = block_steps;
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
  write_block_scene(path("."), 2);
  succeed({"run", "scene.json", "-o", "out", "--set",
           R"(walls.relax={"operations": 1, "rounds": 1, "tries": 1, "rings": 1})"});
  const json relaxed = report("out")["walls"]["relaxed"];
  int sum = 0;
  for (const auto& [kind, count] : relaxed.items()) sum += count.get<int>();
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, block_steps) << "one a step";
}

}  // namespace
}  // namespace cellwalk::test
