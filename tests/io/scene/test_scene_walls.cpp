// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move, in scene files.
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace cellwalk::io {
namespace {

/// A scene of so many dimensions with these walls.
std::string scene_with(const std::string& walls, int dimension = 3) {
  return R"({"environment": "e", "particles": [{"count": 1}], "steps": 1, "dimension": )" +
         std::to_string(dimension) + R"(, "walls": )" + walls + "}";
}

TEST(SceneWalls, Pulsate) {
  const auto scene = std::get<Scene<3>>(parse_scene("s.json", scene_with(R"({"at_contact": "stop",
    "fixed": [{"box": [[0, 0, 0], [1, 2, 3]]}, {"ball": [[4, 5, 6], 7]}],
    "pulsation": {"amplitude": 0.25, "period": 0.5, "wave": [0, 0, 6], "even": 5, "smooth": 12,
                  "quality_floor": 0.3}})")));
  ASSERT_TRUE(scene.walls);
  EXPECT_FALSE(scene.walls->push);
  ASSERT_EQ(scene.walls->fixed.size(), 2u);
  EXPECT_EQ(std::get<Scene_box<3>>(scene.walls->fixed[0]).upper, (Point<3>{1, 2, 3}));
  EXPECT_EQ(std::get<Scene_ball<3>>(scene.walls->fixed[1]).centre, (Point<3>{4, 5, 6}));
  EXPECT_EQ(std::get<Scene_ball<3>>(scene.walls->fixed[1]).radius, 7);
  ASSERT_TRUE(scene.walls->pulsation);
  EXPECT_EQ(scene.walls->pulsation->amplitude, 0.25);
  EXPECT_EQ(scene.walls->pulsation->period, 0.5);
  EXPECT_EQ(scene.walls->pulsation->wave, (Vector<3>{0, 0, 6}));
  EXPECT_EQ(scene.walls->pulsation->even, 5u);
  EXPECT_EQ(scene.walls->pulsation->smooth, 12u);
  EXPECT_EQ(scene.walls->pulsation->quality_floor, 0.3);
  EXPECT_TRUE(scene.walls->motion.empty());
}

TEST(SceneWalls, PushUnlessToldOtherwise) {
  const auto scene = std::get<Scene<2>>(
      parse_scene("s.json", scene_with(R"({"pulsation": {"amplitude": 1, "period": 2}})", 2)));
  EXPECT_TRUE(scene.walls->push);
  EXPECT_FALSE(scene.walls->pulsation->wave);
  EXPECT_EQ(scene.walls->pulsation->even, 0u);
  EXPECT_EQ(scene.walls->pulsation->smooth, 0u);
  EXPECT_EQ(scene.walls->pulsation->quality_floor, 0.2);
  EXPECT_TRUE(scene.walls->fixed.empty());
}

TEST(SceneWalls, Yield) {
  const auto scene = std::get<Scene<3>>(
      parse_scene("s.json", scene_with(R"({"soft": {"compliance": 0.5, "recovery": 0.25, "spread": 3}})")));
  ASSERT_TRUE(scene.walls->soft);
  EXPECT_FALSE(scene.walls->pulsation);
  EXPECT_EQ(scene.walls->soft->compliance, 0.5);
  EXPECT_EQ(scene.walls->soft->recovery, 0.25);
  EXPECT_EQ(scene.walls->soft->spread, 3u);
}

TEST(SceneWalls, FollowATableBesideTheScene) {
  const auto scene =
      std::get<Scene<3>>(parse_scene("s.json", scene_with(R"({"motion": "moves.csv"})"), "folder"));
  EXPECT_EQ(scene.walls->motion, "folder/moves.csv");
  EXPECT_FALSE(scene.walls->pulsation);
  EXPECT_FALSE(std::get<Scene<3>>(parse_scene("s.json", R"({"environment": "e", "particles": [{"count": 1}],
                                                            "steps": 1})"))
                   .walls);
}

TEST(SceneWalls, AreRelaxed) {
  const auto scene = std::get<Scene<3>>(
      parse_scene("s.json", scene_with(R"({"motion": "m.csv", "relax": {"good_enough": 0.25, "rings": 3,
                  "rounds": 5, "operations": 70, "tries": 2}})")));
  ASSERT_TRUE(scene.walls->relax);
  EXPECT_EQ(scene.walls->relax->good_enough, 0.25);
  EXPECT_EQ(scene.walls->relax->rings, 3u);
  EXPECT_EQ(scene.walls->relax->rounds, 5u);
  EXPECT_EQ(scene.walls->relax->operations, 70u);
  EXPECT_EQ(scene.walls->relax->tries, 2u);
  const auto plain =
      std::get<Scene<2>>(parse_scene("s.json", scene_with(R"({"motion": "m.csv", "relax": {}})", 2)));
  ASSERT_TRUE(plain.walls->relax);
  EXPECT_EQ(plain.walls->relax->good_enough, Wall_relaxation{}.good_enough);
  EXPECT_EQ(plain.walls->relax->operations, Wall_relaxation{}.operations);
  EXPECT_FALSE(std::get<Scene<3>>(parse_scene("s.json", scene_with(R"({"motion": "m.csv"})"))).walls->relax);
}

TEST(SceneWalls, AreRefusedWithTheKeyThatIsWrong) {
  struct Refused_walls {
    const char *walls, *message;
  };
  for (const Refused_walls& r : std::initializer_list<Refused_walls>{
           {"3", "s.json: walls: expected an object {...}"},
           {"{}",
            "s.json: walls: nothing moves the walls: give \"pulsation\", \"soft\", "
            "\"tissue\" or \"motion\""},
           {R"({"motion": "m.csv", "pulsation": {"amplitude": 1, "period": 1}})",
            "s.json: walls.pulsation: a table, \"motion\", says alone which points move: leave one of them "
            "out"},
           {R"({"motion": "m.csv", "soft": {}})",
            "s.json: walls.soft: a table, \"motion\", says alone which points move: leave one of them out"},
           {R"({"soft": {"compliance": 0}})",
            "s.json: walls.soft.compliance: expected a number greater than 0, not 0"},
           {R"({"soft": {"recovery": 2}})",
            "s.json: walls.soft.recovery: expected a number from 0 to 1, not 2"},
           {R"({"motion": ""})", "s.json: walls.motion: expected the name of a table"},
           {R"({"motion": "m.csv", "fixed": []})",
            "s.json: walls.fixed: a table, \"motion\", says alone which points move: leave one of them out"},
           {R"({"pulsation": {"period": 1}})", "s.json: walls.pulsation: key \"amplitude\" is missing"},
           {R"({"pulsation": {"amplitude": 0, "period": 1}})",
            "s.json: walls.pulsation.amplitude: expected a number greater than 0, not 0"},
           {R"({"pulsation": {"amplitude": 1, "period": 1, "wave": [0, 0, 0]}})",
            "s.json: walls.pulsation.wave: a direction cannot be zero"},
           {R"({"pulsation": {"amplitude": 1, "period": 1, "even": -1}})",
            "s.json: walls.pulsation.even: expected an integer from 0 to 1000, not -1"},
           {R"({"pulsation": {"amplitude": 1, "period": 1, "smooth": 1001}})",
            "s.json: walls.pulsation.smooth: expected an integer from 0 to 1000, not 1001"},
           {R"({"pulsation": {"amplitude": 1, "period": 1, "quality_floor": 2}})",
            "s.json: walls.pulsation.quality_floor: expected a number from 0 to 1, not 2"},
           {R"({"soft": {}, "relax": {}})",
            "s.json: walls.relax: only cells at points that follow a table, \"motion\", are relaxed: leave "
            "it "
            "out"},
           {R"({"motion": "m.csv", "relax": {"good_enough": 2}})",
            "s.json: walls.relax.good_enough: expected a number from 0 to 1, not 2"},
           {R"({"motion": "m.csv", "relax": {"rings": 0}})",
            "s.json: walls.relax.rings: expected an integer from 1 to 100, not 0"},
           {R"({"motion": "m.csv", "relax": {"tries": 0.5}})",
            "s.json: walls.relax.tries: expected an integer from 1 to 1000, not 0.5"},
           {R"({"motion": "m.csv", "relax": {"much": 1}})",
            "s.json: walls.relax.much: unknown key; known here: good_enough, operations, rings, rounds, "
            "tries"},
           {R"({"at_contact": "hold"})", "s.json: walls.at_contact: expected \"push\" or \"stop\""},
           {R"({"fixed": [{}]})", "s.json: walls.fixed[0]: expected either \"box\" or \"ball\""},
           {R"({"fixed": [{"box": [[0, 0, 0]]}]})",
            "s.json: walls.fixed[0].box: expected the lower and the upper corner"},
           {R"({"fixed": [{"box": [[0, 0, 1], [1, 1, 0]]}]})",
            "s.json: walls.fixed[0].box: the first corner is the lower one in all coordinates"},
           {R"({"fixed": [{"ball": [[0, 0, 1], 0]}]})",
            "s.json: walls.fixed[0].ball[1]: expected a number greater than 0, not 0"}}) {
    try {
      parse_scene("s.json", scene_with(r.walls));
      ADD_FAILURE() << "accepted: " << r.walls;
    } catch (const Error& e) {
      EXPECT_STREQ(e.what(), r.message) << r.walls;
      EXPECT_EQ(e.code(), Error_code::input);
    }
  }
}

}  // namespace
}  // namespace cellwalk::io
