// SPDX-License-Identifier: LGPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// A room of 4 x 3 x 3 unit cells with particles and a catheter that is pushed against its far wall.
constexpr const char* room = R"({
  "title": "A room", "environment": {"generate": "hexes", "cells": [4, 3, 3]},
  "particles": [{"position": [0.5, 0.5, 0.5], "velocity": [9, 7, 5]}, {"count": 20, "seed": 3, "speed": 12}],
  "catheter": {"path": [[2, 1.5, 1.4], [9, 1.5, 1.6]], "spacing": 0.3, "particles": 8},
  "gravity": [0, 0, -1], "restitution": 0.8, "time_step": 0.125, "steps": 40,
  "output": {"frame_every": 15, "picture": {"width": 160, "height": 120}}
})";

constexpr const char* flat_room = R"({
  "dimension": 2, "environment": {"generate": "squares", "cells": 8, "solid": 0.1},
  "particles": [{"count": 30, "speed": 20}], "time_step": 0.125, "steps": 20, "output": {"picture": true}
})";

class Run : public Program {
 protected:
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }
};

double number(const std::string& text) {
  std::size_t used = 0;
  const double value = std::stod(text, &used);
  EXPECT_EQ(used, text.size()) << text;
  return value;
}

TEST_F(Run, WritesWhatHappened) {
  write("room.json", room);
  const std::string said = succeed({"run", "room.json", "-o", "out"});
  for (const char* part :
       {"3D, 40 steps", "21 free", "8 vertices, 2.1 long inside, on its way to waypoint 2 of 2", "36 cells",
        "run.pvd (4 frames)", "picture.png"})
    EXPECT_NE(said.find(part), std::string::npos) << said;

  const json run = report("out");
  const auto table = read_table(path("out/contacts.csv"));
  ASSERT_GT(table.size(), 100u);
  EXPECT_EQ(table[0], (std::vector<std::string>{"step", "particle", "time", "x", "y", "z", "kind", "nx", "ny",
                                                "nz", "cell", "body", "vertex", "feature", "number"}));
  std::map<std::string, std::size_t> kinds{{"vertex", 0}, {"edge", 0}, {"facet", 0}};
  double last_step = 1, of_catheter = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& row = table[i];
    ASSERT_EQ(row.size(), 15u);
    EXPECT_GE(number(row[0]), last_step);
    last_step = number(row[0]);
    EXPECT_NE(row[1].empty(), row[11].empty());
    if (!row[1].empty()) {
      EXPECT_LT(number(row[1]), 21);
    }
    of_catheter += row[11] == "0";
    EXPECT_TRUE(number(row[2]) >= 0 && number(row[2]) <= 1);
    ++kinds.at(row[6]);
    // Every wall of the room is a plane x = 0 or 4, y = 0 or 3, z = 0 or 3; its normal points inwards.
    const double size[] = {4, 3, 3};
    int in_planes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = number(row[3 + axis]), n = number(row[7 + axis]);
      if (n == 0) continue;
      ++in_planes;
      EXPECT_NEAR(x, n > 0 ? 0 : size[axis], 1e-12);
      EXPECT_EQ(std::abs(n), 1);
    }
    EXPECT_EQ(in_planes, 1);
    EXPECT_LT(number(row[10]), 36);
  }
  EXPECT_LE(last_step, 40);
  EXPECT_GT(of_catheter, 10);
  for (const auto& [kind, count] : kinds) EXPECT_EQ(run["contacts"][kind], count);
  EXPECT_EQ(run["steps"], 40);
  EXPECT_EQ(run["particles"]["free"], 21);
  EXPECT_EQ(run["catheter"]["arrived"], false);
  EXPECT_EQ(run["bodies"]["edges"], 7) << "the catheter's";
  EXPECT_EQ(run["validated"], true);
  EXPECT_GT(run["counts"]["walks"], 21 * 40);
  EXPECT_EQ(run["manifest"]["scene"], json::parse(room));
}

TEST_F(Run, TheCollectionNamesEveryFrame) {
  write("room.json", room);
  succeed({"run", "room.json", "-o", "out"});
  const std::string pvd = text("out/run.pvd");
  std::size_t named = 0;
  for (const std::string& file : files())
    if (file.starts_with("out/frames/")) {
      ++named;
      EXPECT_NE(pvd.find(file.substr(4)), std::string::npos) << file;
    }
  EXPECT_EQ(named, 12u) << "particles, the catheter and contacts at steps 0, 15, 30 and 40";
  EXPECT_NE(pvd.find("walls.vtu"), std::string::npos);
  EXPECT_NE(pvd.find("\"5\""), std::string::npos) << "the last time: 40 steps of 1/8";
  for (const std::string& file : files()) EXPECT_EQ(file.find("tmp"), std::string::npos) << file;
}

TEST_F(Run, GivesTheSameBytesEveryTime) {
  for (const char* scene : {room, flat_room}) {
    write("scene.json", scene);
    for (const char* folder : {"a", "b"}) succeed({"run", "scene.json", "-o", folder, "--force"});
    std::size_t compared = 0;
    for (const std::string& file : files()) {
      if (!file.starts_with("a/") || !std::filesystem::is_regular_file(path(file))) continue;
      EXPECT_EQ(text(file), read_text(path("b") / file.substr(2))) << file;
      ++compared;
    }
    EXPECT_GE(compared, 8u);
  }
}

TEST_F(Run, CathetersOfTheShippedScenesArrive) {
  for (const char* scene : {"vessel.json", "rooms.json", "catheter.json"}) {
    succeed({"run", std::string(CELLWALK_SHIPPED_DATA "/").append(scene), "-o", "out", "--force"});
    const auto report = nlohmann::json::parse(text("out/run.json"));
    EXPECT_TRUE(report.at("catheter").at("arrived")) << scene;
    EXPECT_TRUE(report.at("validated")) << scene;
    const json& met = report.at("bodies").at("contacts").at("edge");
    EXPECT_GT(met.at("vertex").get<int>() + met.at("edge").get<int>(), 100) << scene;
  }
}

TEST_F(Run, WithoutASceneHexahedraBounce) {
  const std::vector<std::string> smaller{"--set", "bodies[0].count=20",   "--set",   "environment.cells=5",
                                         "--set", "output.picture=false", "--steps", "50"};
  std::vector<std::string> arguments{"run", "-o", "out"};
  arguments.insert(arguments.end(), smaller.begin(), smaller.end());
  const std::string said = succeed(arguments);
  EXPECT_NE(said.find("hexahedra.json (built in): 3D, 50 steps"), std::string::npos) << said;
  EXPECT_EQ(report("out")["bodies"]["vertices"], 160);
  EXPECT_EQ(report("out")["environment"]["cells"], 125);
  EXPECT_EQ(report("out")["manifest"]["scene"]["bodies"][0]["count"], 20);
  // The file says the same.
  arguments = {"run", CELLWALK_SHIPPED_DATA "/hexahedra.json", "-o", "of_file"};
  arguments.insert(arguments.end(), smaller.begin(), smaller.end());
  succeed(arguments);
  for (const char* file : {"run.json", "contacts.csv"})
    EXPECT_EQ(text(std::string("out/") + file), text(std::string("of_file/") + file));
  expect_failure(2, {"run", "-o", "other", "--set", "bodies[9].count=1"}, {"there is no element 9"});
  expect_failure(3, {"run", "-o", "other", "--set", "bodies[0].cout=1"},
                 {"hexahedra.json (built in): bodies[0].cout: unknown key"});
}

TEST_F(Run, LeavesThirdCoordinatesEmptyInThePlane) {
  write("flat.json", flat_room);
  succeed({"run", "flat.json", "-o", "out"});
  const auto table = read_table(path("out/contacts.csv"));
  ASSERT_GT(table.size(), 50u);
  for (std::size_t i = 1; i < table.size(); ++i) {
    EXPECT_EQ(table[i][5], "");
    EXPECT_EQ(table[i][9], "");
    EXPECT_NEAR(std::hypot(number(table[i][7]), number(table[i][8])), 1, 1e-15);
  }
  EXPECT_GT(text("out/picture.png").size(), 10000u);
}

TEST_F(Run, ReadsAnEnvironmentBesideTheScene) {
  succeed({"generate", "hexes", "--cells", "3", "-o", "env.ovm"});
  std::filesystem::create_directory(path("sub"));
  write("sub/scene.json", R"({"environment": "../env.ovm", "particles": [{"count": 3}], "steps": 5,
                              "output": {"frame_every": 0}})");
  succeed({"run", "sub/scene.json", "-o", "out", "--steps", "7"});
  EXPECT_EQ(report("out")["steps"], 7);
  EXPECT_EQ(report("out")["environment"]["cells"], 27);
  std::vector<std::string> written;
  for (const std::string& file : files())
    if (file.starts_with("out/")) written.push_back(file);
  EXPECT_EQ(written, (std::vector<std::string>{"out/contacts.csv", "out/motion.gz", "out/run.json"}))
      << "neither frames nor picture";
}

TEST_F(Run, ReplacesOnlyAnEarlierRunAndOnlyIfToldTo) {
  write("room.json", room);
  succeed({"run", "room.json", "-o", "out", "--steps", "2"});
  expect_failure(2, {"run", "room.json", "-o", "out"}, {"out: exists already", "--force"});
  EXPECT_EQ(report("out")["steps"], 2);
  succeed({"run", "room.json", "-o", "out", "--steps", "3", "--force"});
  EXPECT_EQ(report("out")["steps"], 3);
  std::filesystem::create_directory(path("precious"));
  write("precious/thesis.txt", "mine");
  expect_failure(2, {"run", "room.json", "-o", "precious", "--force"}, {"precious: holds no run.json"});
  EXPECT_EQ(text("precious/thesis.txt"), "mine");
}

TEST_F(Run, RefusesWithTheKeyThatIsWrong) {
  const auto refuse = [this](int exit_code, const std::string& scene, const std::vector<std::string>& texts) {
    write("s.json", scene);
    expect_failure(exit_code, {"run", "s.json", "-o", "out"}, texts);
  };
  const std::string rest = R"(, "particles": [{"count": 1}], "steps": 1})";
  refuse(3, R"({"environment": "nowhere.ovm")" + rest, {"nowhere.ovm"});
  refuse(3, R"({"environment": {"generate": "spheres"})" + rest, {"s.json: environment: ", "spheres"});
  refuse(3, R"({"environment": {"generate": "hexes", "colour": 1})" + rest,
         {"s.json: environment: ", "colour"});
  refuse(3, R"({"environment": {"generate": "squares"})" + rest,
         {"s.json: dimension: the environment is of dimension 2, the scene of 3"});
  refuse(3, R"({"environment": {"generate": "hexes"}, "particles": [{"position": [1, 2]}], "steps": 1})",
         {"s.json: particles[0].position: expected 3 numbers"});
  refuse(5, R"({"environment": {"generate": "hexes"}, "particles": [{"position": [1, 2, 99]}], "steps": 1})",
         {"s.json: particles[0].position: (1, 2, 99) lies outside the environment"});
  expect_failure(3, {"run", "missing.json", "-o", "out"}, {"missing.json"});
  expect_failure(2, {"run", "s.json"}, {"--output is required"});
  expect_failure(2, {"run", "s.json", "-o", "out", "--steps", "0"}, {"--steps"});
  write("room.json", room);
  expect_failure(1, {"run", "room.json", "-o", "no/such/folder"}, {"no/such/folder: cannot be made"});
}

TEST_F(Run, LeavesNothingWhenItIsInterrupted) {
  write("long.json", R"({"environment": {"generate": "hexes"}, "particles": [{"count": 2000, "speed": 50}],
                         "steps": 1000000, "output": {"frame_every": 1}})");
  const auto before = files();
  for (const int milliseconds :
       {10, 30, 90, 700}) {  // also while the scene is read and the environment is made
    interrupt_program({"run", "long.json", "-o", "out", "--json", "r.json"}, path(""), milliseconds);
    EXPECT_EQ(files(), before) << milliseconds;
  }
}

}  // namespace
}  // namespace cellwalk::test
