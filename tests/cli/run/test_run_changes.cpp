// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes in which facets and cells change, as `cellwalk run` runs, reports and refuses them.
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

using nlohmann::json;

/// Squares in the plane, 6 in a row and 3 high; a door at x = 3 is shut until step 5.
std::string room_with_door(const std::string& more) {
  return R"({"dimension": 2, "environment": {"generate": "squares", "cells": [6, 3]},
    "particles": [{"position": [1.5, 1.5], "velocity": [1, 0]}],
    "groups": {"door": {"plane": [[3, 0], [1, 0]]}},
    "changes": [{"step": 1, "close": "door"}, {"step": 5, "open": "door"}],
    "time_step": 1, "steps": 8)" +
         more + "}";
}

class RunChanges : public Program {
 protected:
  json report(const std::string& folder) const { return json::parse(text(folder + "/run.json")); }
};

TEST_F(RunChanges, AParticleBouncesAtADoorUntilItOpens) {
  write("room.json", room_with_door(R"(, "output": {"frame_every": 4, "motion_every": 1})"));
  const std::string said = succeed({"run", "room.json", "-o", "out"});
  EXPECT_NE(said.find("3 facets opened, 3 facets closed"), std::string::npos) << said;
  EXPECT_NE(said.find("changes.csv"), std::string::npos);
  const json run = report("out");
  EXPECT_EQ(run["changes"]["closed"], 3);
  EXPECT_EQ(run["changes"]["left"], 0);
  const auto rows = read_table(path("out/changes.csv"));
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[1][0], "1");
  EXPECT_EQ(rows[6][0], "5");
  // It meets the door at 3 in step 2, the boundary at 0 in step 5, and passes where the door was in step 8.
  const auto contacts = read_table(path("out/contacts.csv"));
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[1][0], "2");
  EXPECT_EQ(contacts[1][3], "3");
  EXPECT_EQ(contacts[2][3], "0");
  ASSERT_TRUE(exists("out/frames/walls_00000.vtu") && exists("out/motion.gz"));
  EXPECT_NE(text("out/frames/walls_00000.vtu"), text("out/frames/walls_00001.vtu"));
  EXPECT_EQ(text("out/frames/walls_00000.vtu"), text("out/frames/walls_00002.vtu"));
}

TEST_F(RunChanges, AreTheSameForAnyNumberOfThreads) {
  write("rooms.json", R"({"environment": {"generate": "hexes", "cells": [6, 4, 4], "solid": 0.05},
    "bodies": [{"shape": "box", "size": [0.3, 0.3, 0.3], "count": 12, "seed": 3, "speed": 3}],
    "changes": [{"step": 5, "until": 20, "close": {"plane": [[3, 0, 0], [1, 0, 0]]}},
                {"step": 10, "excavate": {"box": [[0, 0, 0], [6, 4, 4]]}},
                {"step": 22, "until": 30, "fill": {"ball": [[1.5, 1.5, 1.5], 1]}}],
    "time_step": 0.05, "steps": 30, "output": {"frame_every": 10}})");
  succeed({"run", "rooms.json", "-o", "one", "--threads", "1"});
  succeed({"run", "rooms.json", "-o", "two", "--threads", "2"});
  for (const char* file : {"changes.csv", "contacts.csv", "run.json", "frames/walls_00003.vtu"})
    EXPECT_EQ(text(std::string("one/") + file), text(std::string("two/") + file)) << file;
  const json changes = report("one")["changes"];
  EXPECT_GT(changes["closed"].get<int>(), 8);
  EXPECT_GT(changes["excavated"].get<int>(), 0);
}

/// For a cut, cells of the file are split: the parts of one that has a name have it, too.
TEST_F(RunChanges, NameTheGroupsOfAFileWhoseCellsAreSplit) {
  succeed({"generate", "squares", "--cells", "6", "3", "-o", "room.ovm"});
  std::string plug;
  for (int i = 0; i < 18; ++i) plug += i == 5 ? " 1" : " 0";  // the last of the lowest row
  write("room.ovm", text("room.ovm") + "FProp bool \"group plug\"\n" + plug + "\n");
  write("room.json", R"({"dimension": 2, "environment": "room.ovm", "particles": [{"position": [0.5, 2.5]}],
    "changes": [{"step": 1, "fill": "plug"}, {"step": 2, "cut": {"blade": [[3.1, 2.1], [3.2, 2.9]]}}],
    "steps": 2})");
  succeed({"run", "room.json", "-o", "out"});
  EXPECT_EQ(report("out")["changes"]["filled"], 2);
  const auto rows = read_table(path("out/changes.csv"));
  ASSERT_GE(rows.size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_GT(std::stod(rows[i][6]), 5);
    EXPECT_LT(std::stod(rows[i][7]), 1);
  }
}

TEST_F(RunChanges, AreRefused) {
  write("room.json", room_with_door(R"(, "output": {"frame_every": 0})"));
  expect_failure(3, {"run", "room.json", "-o", "out", "--set", "changes[0].close={\"ball\": [[9, 9], 1]}"},
                 {"room.json: changes[0].close: no facet between two cells of the environment lies there"});
  EXPECT_FALSE(exists("out"));
  write("space.json", R"({"environment": {"generate": "hexes", "cells": 3},
    "bodies": [{"shape": "box", "size": [0.3, 0.3, 0.3], "count": 1}],
    "changes": [{"step": 1, "close": {"plane": [[1, 0, 0], [1, 0, 0]]}}], "steps": 1})");
  expect_failure(3, {"run", "space.json", "-o", "out", "--record", "trace"},
                 {"space.json: changes: a trace has walls that stay as they are"});
}

}  // namespace
}  // namespace cellwalk::test
