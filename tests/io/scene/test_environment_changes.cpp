// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of an environment, in scene files and by themselves.
#include <cellwalk/internal/io/changes_file.h>
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace cellwalk::io {
namespace {

std::string scene_of_changes(const std::string& keys) {
  return R"({"environment": "e", "particles": [{"count": 1}], "steps": 9, )" + keys + "}";
}

TEST(EnvironmentChanges, NameGroupsAndParts) {
  const auto scene = std::get<Scene<3>>(parse_scene("s.json", scene_of_changes(R"(
    "groups": {"valve": {"plane": [[1, 2, 3], [0, 0, 2]], "ball": [[1, 1, 1], 4]}},
    "changes": [{"step": 4, "close": "valve", "until": 7}, {"step": 8, "open": "valve"},
                {"step": 1, "excavate": {"box": [[0, 0, 0], [1, 2, 3]]}},
                {"step": 2, "fill": {"plane": [[0, 0, 0], [1, 0, 0]]}}])")));
  ASSERT_EQ(scene.changes.groups.size(), 1u);
  const Environment_part<3>& valve = scene.changes.groups.at("valve");
  EXPECT_EQ(valve.plane->point, (Point<3>{1, 2, 3}));
  EXPECT_EQ(valve.plane->normal, (Vector<3>{0, 0, 2}));
  EXPECT_EQ(std::get<Scene_ball<3>>(*valve.shape).radius, 4);
  const auto& list = scene.changes.list;
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].kind, Change_kind::close);
  EXPECT_EQ(list[0].part.group, "valve");
  EXPECT_EQ(list[0].step, 4u);
  EXPECT_EQ(list[0].until, 7u);
  EXPECT_EQ(list[1].kind, Change_kind::open);
  EXPECT_EQ(list[1].until, 8u);
  EXPECT_EQ(list[2].kind, Change_kind::excavate);
  EXPECT_EQ(std::get<Scene_box<3>>(*list[2].part.shape).upper, (Point<3>{1, 2, 3}));
  EXPECT_FALSE(list[2].part.plane);
  EXPECT_EQ(list[3].kind, Change_kind::fill);
  EXPECT_FALSE(list[3].part.shape);
  EXPECT_TRUE(list[3].part.group.empty());
}

TEST(EnvironmentChanges, ByThemselvesHaveNoSteps) {
  const auto changes = parse_changes<2>("c.json", R"({
    "groups": {"door": {"box": [[0, 0], [1, 1]]}},  // in the plane
    "changes": [{"open": "door"}, {"fill": {"ball": [[2, 3], 1]}}, {"sew": {"ball": [[4, 5], 1]}}]})");
  ASSERT_EQ(changes.list.size(), 3u);
  EXPECT_EQ(changes.list[0].kind, Change_kind::open);
  EXPECT_EQ(changes.list[0].step, 1u);
  EXPECT_EQ(std::get<Scene_ball<2>>(*changes.list[1].part.shape).centre, (Point<2>{2, 3}));
  EXPECT_EQ(changes.list[2].kind, Change_kind::sew);
  EXPECT_EQ(std::get<Scene_ball<2>>(*changes.list[2].part.shape).centre, (Point<2>{4, 5}));
}

template <class Parse>
void expect_refusal(const std::string& text, const std::string& message, const Parse& parse) {
  try {
    parse(text);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const Error& e) {
    EXPECT_EQ(e.what(), message) << text;
    EXPECT_EQ(e.code(), Error_code::input);
  }
}

struct Refused_changes {
  const char *text, *message;
};

TEST(EnvironmentChanges, AreRefusedWithTheKeyThatIsWrong) {
  for (const Refused_changes& r : std::initializer_list<Refused_changes>{
           {R"("changes": [{"step": 1}])",
            "s.json: changes[0]: expected one of \"open\", \"close\", \"excavate\", \"fill\", \"cut\" and "
            "\"sew\""},
           {R"("changes": [{"step": 1, "open": {"ball": [[0, 0, 0], 1]}, "fill": {"ball": [[0, 0, 0], 1]}}])",
            "s.json: changes[0]: expected one of \"open\", \"close\", \"excavate\", \"fill\", \"cut\" and "
            "\"sew\""},
           {R"("changes": [{"open": {"ball": [[0, 0, 0], 1]}}])",
            "s.json: changes[0]: key \"step\" is missing"},
           {R"("changes": [{"step": 0, "open": {"ball": [[0, 0, 0], 1]}}])",
            "s.json: changes[0].step: expected an integer from 1 to 100000000, not 0"},
           {R"("changes": [{"step": 5, "until": 4, "open": {"ball": [[0, 0, 0], 1]}}])",
            "s.json: changes[0].until: expected an integer from 5 to 100000000, not 4"},
           {R"("changes": [{"step": 1, "sew": "valve"}])",
            "s.json: changes[0].sew: a group has no stitches: give \"box\", \"ball\" or \"plane\""},
           {R"("changes": [{"step": 1, "sew": {}}])",
            "s.json: changes[0].sew: expected \"box\", \"ball\" or \"plane\""},
           {R"("changes": [{"step": 1, "close": ""}])", "s.json: changes[0].close: a group needs a name"},
           {R"("changes": [{"step": 1, "close": {}}])",
            "s.json: changes[0].close: expected \"box\", \"ball\" or \"plane\""},
           {R"("changes": [{"step": 1, "close": 3}])",
            "s.json: changes[0].close: expected an object with \"box\", \"ball\" or \"plane\""},
           {R"("changes": [{"step": 1, "close": {"plane": [[0, 0, 0]]}}])",
            "s.json: changes[0].close.plane: expected a point of it and its normal"},
           {R"("changes": [{"step": 1, "close": {"plane": [[0, 0, 0], [0, 0, 0]]}}])",
            "s.json: changes[0].close.plane: a normal cannot be zero"},
           {R"("changes": [{"step": 1, "close": {"box": [[0, 0, 0], [1, 1, 1]], "ball": [[0, 0, 0], 1]}}])",
            "s.json: changes[0].close: expected either \"box\" or \"ball\""},
           {R"("groups": {"": {"ball": [[0, 0, 0], 1]}}, "changes": [])",
            "s.json: groups: a group needs a name"},
           {R"("groups": {"a": {"ball": [[0, 0, 0], 1]}})",
            "s.json: groups: no change names a group: give \"changes\" as well"}})
    expect_refusal(scene_of_changes(r.text), r.message,
                   [](const std::string& t) { parse_scene("s.json", t); });
}

TEST(EnvironmentChanges, ByThemselvesAreRefusedAlike) {
  for (const Refused_changes& r : std::initializer_list<Refused_changes>{
           {"{}", "c.json: key \"changes\" is missing"},
           {R"({"changes": []})", "c.json: changes: nothing is to be changed"},
           {R"({"changes": [{"step": 1, "open": {"ball": [[0, 0], 1]}}]})",
            "c.json: changes[0].step: unknown key; known here: close, cut, excavate, fill, open, sew"},
           {R"({"changes": [{"open": {"ball": [[0, 0, 0], 1]}}]})",
            "c.json: changes[0].open.ball[0]: expected 2 numbers"}})
    expect_refusal(r.text, r.message, [](const std::string& t) { parse_changes<2>("c.json", t); });
}

}  // namespace
}  // namespace cellwalk::io
