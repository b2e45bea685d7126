// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace cellwalk::io {
namespace {

constexpr const char* complete = R"({  // everything
  "dimension": 3, "title": "A test", "environment": {"generate": "vessel", "radius": 2.5, "size": [1, 2, 3]},
  "particles": [{"position": [1, 2, 3], "velocity": [0.5, 0, -1e-3]}, {"position": [0, 0, 0]},
                {"count": 7, "speed": 2, "seed": 9007199254740992}],
  "catheter": {"particles": 9, "spacing": 0.5, "advance": 0.125, "stiffness": 0.75, "find_route": true,
               "steering": "twist", "tip": {"length": 2, "degrees": 45}, "twist": 5,
               "path": [[0, 0, 0], [1, 0, 0], [1, 1, 0]]},
  "gravity": [0, 0, -9.81], "restitution": 0.5, "friction": 0.25, "time_step": 0.5, "steps": 12,
  "output": {"frame_every": 3, "motion_every": 4,
             "picture": {"width": 320, "height": 200, "toward": [0, 0, 1], "up": [0, 1, 0]}}
})";

TEST(Scene, ReadsEveryKey) {
  const auto scene = std::get<Scene<3>>(parse_scene("s.json", complete));
  EXPECT_EQ(scene.title, "A test");
  const auto& recipe = std::get<Generator_call>(scene.environment);
  EXPECT_EQ(recipe.generator, "vessel");
  EXPECT_EQ(recipe.options.at("radius"), std::vector<double>{2.5});
  EXPECT_EQ(recipe.options.at("size"), (std::vector<double>{1, 2, 3}));
  ASSERT_EQ(scene.particles.size(), 3u);
  const auto& first = std::get<Particle_start<3>>(scene.particles[0]);
  EXPECT_EQ(first.position, (Point<3>{1, 2, 3}));
  EXPECT_EQ(first.velocity, (Vector<3>{0.5, 0, -1e-3}));
  EXPECT_EQ(std::get<Particle_start<3>>(scene.particles[1]).velocity, (Vector<3>{0, 0, 0}));
  const auto& cloud = std::get<Particle_cloud>(scene.particles[2]);
  EXPECT_EQ(cloud.count, 7u);
  EXPECT_EQ(cloud.speed, 2);
  EXPECT_EQ(cloud.seed, 9007199254740992u);
  ASSERT_TRUE(scene.catheter);
  EXPECT_EQ(scene.catheter->particles, 9u);
  EXPECT_EQ(scene.catheter->spacing, 0.5);
  EXPECT_EQ(scene.catheter->advance, 0.125);
  EXPECT_EQ(scene.catheter->stiffness, 0.75);
  EXPECT_TRUE(scene.catheter->find_route);
  EXPECT_EQ(scene.catheter->path.size(), 3u);
  EXPECT_EQ(scene.catheter->steering, Steering::twist);
  EXPECT_EQ(scene.catheter->tip_length, 2);
  EXPECT_EQ(scene.catheter->tip_angle, 45);
  EXPECT_EQ(scene.catheter->twist, 5);
  EXPECT_EQ(scene.gravity, (Vector<3>{0, 0, -9.81}));
  EXPECT_EQ(scene.restitution, 0.5);
  EXPECT_EQ(scene.friction, 0.25);
  EXPECT_EQ(scene.time_step, 0.5);
  EXPECT_EQ(scene.steps, 12u);
  EXPECT_EQ(scene.output.frame_every, 3u);
  EXPECT_EQ(scene.output.motion_every, 4u);
  ASSERT_TRUE(scene.output.picture);
  EXPECT_EQ(scene.output.picture->width, 320);
  EXPECT_EQ(scene.output.picture->height, 200);
  EXPECT_EQ(scene.output.picture->toward, (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(scene.output.picture->up, (std::vector<double>{0, 1, 0}));
}

TEST(Scene, HasDefaults) {
  const auto scene = std::get<Scene<2>>(parse_scene(
      "s.json", R"({"dimension": 2, "environment": "a.ovm", "particles": [{"count": 1}], "steps": 5})"));
  EXPECT_EQ(std::get<std::string>(scene.environment), "a.ovm");
  EXPECT_EQ(scene.restitution, 1);
  EXPECT_EQ(scene.friction, 0);
  EXPECT_FALSE(scene.catheter);
  EXPECT_FALSE(scene.output.picture);
  const auto tip = std::get<Scene<3>>(parse_scene("s.json", R"({"environment": "a.ovm", "steps": 5,
    "catheter": {"spacing": 3, "path": [[0,0,0],[1,1,1]]}, "output": {"picture": true}})"));
  EXPECT_EQ(tip.catheter->advance, 1.5);
  EXPECT_EQ(tip.catheter->steering, Steering::tip);
  EXPECT_EQ(tip.catheter->tip_angle, 0);
  EXPECT_TRUE(tip.output.picture);
}

TEST(Scene, ReadsTheEndsOfACatheter) {
  const auto scene = std::get<Scene<3>>(parse_scene("s.json", R"({"environment": "a.ovm", "steps": 5,
    "catheter": {"from": "cap_1", "to": [1, 2, 3]}})"));
  EXPECT_EQ(std::get<std::string>(scene.catheter->ends.value().from), "cap_1");
  EXPECT_EQ(std::get<Point<3>>(scene.catheter->ends->to), (Point<3>{1, 2, 3}));
  EXPECT_TRUE(scene.catheter->path.empty());
  EXPECT_EQ(scene.catheter->spacing, 0) << "follows from the centre line";
  EXPECT_EQ(scene.catheter->advance, 0);
  EXPECT_EQ(scene.catheter->particles, 0u);
  const auto given = std::get<Scene<3>>(parse_scene("s.json", R"({"environment": "a.ovm", "steps": 5,
    "catheter": {"from": "cap_1", "to": "cap_2", "spacing": 3, "particles": 7}})"));
  EXPECT_EQ(given.catheter->spacing, 3);
  EXPECT_EQ(given.catheter->advance, 1.5);
  EXPECT_EQ(given.catheter->particles, 7u);
}

TEST(Scene, ReadsAnImport) {
  const auto text =
      R"({"environment": {"import": "a.stl", "obstacle": "b.stl", "quality": 2, "mesher": "mesh3",
    "keep_obstacles": true, "inside": [1, 2, 3]}, "particles": [{"count": 1}], "steps": 1})";
  const auto scene = std::get<Scene<3>>(parse_scene("s.json", text, "folder"));
  const auto& call = std::get<Import_call>(scene.environment);
  EXPECT_EQ(call.file, "folder/a.stl");
  EXPECT_EQ(call.obstacles, std::vector<std::string>{"folder/b.stl"});
  EXPECT_EQ(call.cache, "folder/.cellwalk-cache");
  ASSERT_EQ(call.options.size(), 4u);
  EXPECT_EQ(std::get<double>(call.options.at("quality")), 2);
  EXPECT_EQ(std::get<std::string>(call.options.at("mesher")), "mesh3");
  EXPECT_TRUE(std::get<bool>(call.options.at("keep_obstacles")));
  EXPECT_EQ(std::get<std::vector<double>>(call.options.at("inside")), (std::vector<double>{1, 2, 3}));
}

TEST(Scene, ResolvesTheEnvironmentAgainstItsFolder) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "scene_folder";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "s.json")
      << R"({"environment": "sub/a.ovm", "particles": [{"count": 1}], "steps": 1})";
  const auto scene = std::get<Scene<3>>(read_scene(folder / "s.json"));
  EXPECT_EQ(std::get<std::string>(scene.environment), (folder / "sub/a.ovm").string());
}

struct Refusal {
  const char* text;
  const char* message;
};

/// What goes wrong when a member of a good scene is replaced; the path of the key leads.
const Refusal scene_refusals[] = {
    {"[]", "s.json: expected an object {...}"},
    {"{\n\"steps\": 1,\n\"steps\": 2}", "s.json: steps: key given twice in one object"},
    {R"({"dimension": 4})", "s.json: dimension: expected an integer from 2 to 3, not 4"},
    {R"({"dimension": "3"})", "s.json: dimension: expected an integer from 2 to 3"},
    {R"({})", "s.json: key \"environment\" is missing"},
    {R"({"environment": ""})", "s.json: environment: expected the name of a mesh file"},
    {R"({"environment": 3})",
     "s.json: environment: expected the name of a mesh file, {\"import\": ...} or {\"generate\": ...}"},
    {R"({"environment": {"import": ""}})", "s.json: environment.import: expected the name of a mesh file"},
    {R"({"environment": {"import": "x", "obstacle": ["y", 1]}})",
     "s.json: environment.obstacle[1]: expected a text"},
    {R"({"environment": {"import": "x", "quality": null}})",
     "s.json: environment.quality: expected a number"},
    {R"({"environment": {}})", "s.json: environment: key \"generate\" is missing"},
    {R"({"environment": {"generate": 1}})", "s.json: environment.generate: expected a text"},
    {R"({"environment": {"generate": "x", "a": "b"}})",
     "s.json: environment.a: expected a number or a list of numbers"},
    {R"({"environment": {"generate": "x", "a": [1, null]}})", "s.json: environment.a[1]: expected a number"},
    {R"({"environment": "e", "particle": []})",
     "s.json: particle: unknown key; known here: bodies, catheter, changes, dimension, environment, "
     "friction, "
     "gravity, groups, output, particles, "
     "restitution, steps, time_step, title, walls"},
    {R"({"environment": "e", "title": 3})", "s.json: title: expected a text"},
    {R"({"environment": "e", "steps": 1})",
     "s.json: nothing moves: give \"particles\", \"bodies\" or \"catheter\""},
    {R"({"environment": "e", "particles": {}})", "s.json: particles: expected a list [...]"},
    {R"({"environment": "e", "particles": [1]})", "s.json: particles[0]: expected an object {...}"},
    {R"({"environment": "e", "particles": [{}]})",
     "s.json: particles[0]: expected \"position\" or \"count\""},
    {R"({"environment": "e", "particles": [{"position": [1, 2]}]})",
     "s.json: particles[0].position: expected 3 numbers"},
    {R"({"environment": "e", "particles": [{"count": 1}, {"position": [1, 2, 3], "velocity": [1, 2, "3"]}]})",
     "s.json: particles[1].velocity: expected 3 numbers"},
    {R"({"environment": "e", "particles": [{"position": [1, 2, 3], "speed": 1}]})",
     "s.json: particles[0].speed: only for random particles: give \"count\" as well"},
    {R"({"environment": "e", "particles": [{"position": [1, 2, 3], "mass": 1}]})",
     "s.json: particles[0].mass: unknown key; known here: count, position, seed, speed, velocity"},
    {R"({"environment": "e", "particles": [{"count": 1, "position": [1, 2, 3]}]})",
     "s.json: particles[0].position: unknown key; known here: count, seed, speed"},
    {R"({"environment": "e", "particles": [{"count": 0}]})",
     "s.json: particles[0].count: expected an integer from 1 to 10000000, not 0"},
    {R"({"environment": "e", "particles": [{"count": 1.5}]})",
     "s.json: particles[0].count: expected an integer from 1 to 10000000, not 1.5"},
    {R"({"environment": "e", "particles": [{"count": 1, "seed": -1}]})",
     "s.json: particles[0].seed: expected an integer from 0 to 9007199254740992, not -1"},
    {R"({"environment": "e", "catheter": {"path": [[0,0,0],[1,1,1]]}})",
     "s.json: catheter: key \"spacing\" is missing"},
    {R"({"environment": "e", "catheter": {"from": "cap_1"}})", "s.json: catheter: key \"to\" is missing"},
    {R"({"environment": "e", "catheter": {"from": 1, "to": "cap_2"}})",
     "s.json: catheter.from: expected the name of a group, or a point"},
    {R"({"environment": "e", "catheter": {"from": "cap_1", "to": [1, 2]}})",
     "s.json: catheter.to: expected 3 numbers"},
    {R"({"environment": "e", "catheter": {"from": "cap_1", "to": "cap_2", "path": [[0,0,0],[1,1,1]]}})",
     "s.json: catheter.path: the path is found between \"from\" and \"to\": leave it out"},
    {R"({"environment": "e", "catheter": {"spacing": 0, "path": []}})",
     "s.json: catheter.spacing: expected a number greater than 0, not 0"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "path": [[0,0,0]]}})",
     "s.json: catheter.path: expected at least 2 waypoints"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "path": [[0,0,0],[0,0,0]]}})",
     "s.json: catheter.path[1]: the same waypoint twice in a row"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "particles": 1, "path": []}})",
     "s.json: catheter.particles: expected an integer from 2 to 10000000, not 1"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "steering": "hand", "path": []}})",
     "s.json: catheter.steering: expected \"tip\", \"twist\" or \"none\""},
    {R"({"environment": "e", "catheter": {"spacing": 1, "steering": "twist", "path": []}})",
     "s.json: catheter: steering by \"twist\" needs a curved \"tip\""},
    {R"({"environment": "e", "catheter": {"spacing": 1, "tip": {"length": 1}, "path": []}})",
     "s.json: catheter.tip: key \"degrees\" is missing"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "tip": {"length": 0, "degrees": 5}, "path": []}})",
     "s.json: catheter.tip.length: expected a number greater than 0, not 0"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "tip": {"length": 1, "degrees": 500}, "path": []}})",
     "s.json: catheter.tip.degrees: expected a number from 0 to 360, not 500"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "twist": 5, "path": []}})",
     "s.json: catheter.twist: only for \"steering\" by \"twist\" or \"none\""},
    {R"({"environment": "e", "catheter": {"spacing": 1, "steering": "none", "twist": 181, "path": []}})",
     "s.json: catheter.twist: expected a number from -180 to 180, not 181"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "stiffness": 1.5, "path": []}})",
     "s.json: catheter.stiffness: expected a number from 0 to 1, not 1.5"},
    {R"({"environment": "e", "catheter": {"spacing": 1, "find_route": 1, "path": []}})",
     "s.json: catheter.find_route: expected true or false"},
    {R"({"environment": "e", "particles": [{"count": 1}], "gravity": 9.81})",
     "s.json: gravity: expected 3 numbers"},
    {R"({"environment": "e", "particles": [{"count": 1}], "restitution": 2})",
     "s.json: restitution: expected a number from 0 to 1, not 2"},
    {R"({"environment": "e", "particles": [{"count": 1}], "friction": "no"})",
     "s.json: friction: expected a number"},
    {R"({"environment": "e", "particles": [{"count": 1}], "time_step": -1})",
     "s.json: time_step: expected a number greater than 0, not -1"},
    {R"({"environment": "e", "particles": [{"count": 1}]})", "s.json: key \"steps\" is missing"},
    {R"({"environment": "e", "particles": [{"count": 1}], "steps": 1, "output": {"picture": 1}})",
     "s.json: output.picture: expected true or false"},
    {R"({"environment": "e", "particles": [{"count": 1}], "steps": 1, "output": {"picture": {"width": 5}}})",
     "s.json: output.picture.width: expected an integer from 16 to 16384, not 5"},
    {R"({"environment": "e", "particles": [{"count": 1}], "steps": 1, "output": {"picture":)"
     R"( {"up": [0, 0, 0]}}})",
     "s.json: output.picture.up: a direction cannot be zero"},
};

TEST(Scene, RefusesWithTheKeyThatIsWrong) {
  for (const Refusal& r : scene_refusals) {
    try {
      parse_scene("s.json", r.text);
      ADD_FAILURE() << "accepted: " << r.text;
    } catch (const Error& e) {
      EXPECT_STREQ(e.what(), r.message) << r.text;
      EXPECT_EQ(e.code(), Error_code::input);
    }
  }
}

TEST(Scene, NamesTheLineOfASyntaxError) {
  const auto message = [](const char* text) -> std::string {
    try {
      parse_scene("s.json", text);
    } catch (const Error& e) {
      return e.what();
    }
    return "accepted";
  };
  // What follows are words of nlohmann's, which differ by its version.
  EXPECT_EQ(message("").rfind("s.json:1: not valid JSON: ", 0), 0u);
  EXPECT_EQ(message("{\n  \"steps\": 1,\n  oops\n}").rfind("s.json:3: not valid JSON: ", 0), 0u);
  EXPECT_EQ(message("{\"steps\": 1e999}").rfind("s.json: not valid JSON: ", 0), 0u);
  EXPECT_NE(message("{\"steps\": 1e999}").find("1e999"), std::string::npos);
}

TEST(Scene, RefusesNulInEveryText) {
  const std::string whole =
      R"({"environment": "e.ovm", "title": "t", "bodies": [{"file": "b.off", "count": 1}], "steps": 1,
          "groups": {"door": {"ball": [[0, 0, 0], 1]}}, "changes": [{"step": 1, "open": "door"}],
          "walls": {"motion": "m.csv", "at_contact": "stop"}, "catheter": {"spacing": 1, "steering": "none",
          "path": [[0, 0, 0], [1, 0, 0]]}})";
  EXPECT_NO_THROW(parse_scene("s.json", whole));
  int texts = 0, named = 0;
  for (std::size_t open = whole.find('"'); open != std::string::npos;) {
    const std::size_t close = whole.find('"', open + 1);
    for (std::size_t at = open + 1; at <= close; ++at) {
      std::string with_nul = whole;
      with_nul.insert(at, "\\u0000");
      try {
        parse_scene("s.json", with_nul);
        ADD_FAILURE() << with_nul;
      } catch (const Error& e) {
        ++texts;
        named += std::string(e.what()).find("NUL character: leave it out") != std::string::npos;
      }
    }
    open = whole.find('"', close + 1);
  }
  EXPECT_GT(texts, 150);
  EXPECT_GT(named, texts - 20) << "a key without which nothing else is known";
}

TEST(Scene, NamesAFileThatCannotBeRead) {
  EXPECT_THROW(
      {
        try {
          read_scene("/nowhere/s.json");
        } catch (const Error& e) {
          EXPECT_STREQ(e.what(), "/nowhere/s.json: cannot be opened: check that it exists and may be read");
          throw;
        }
      },
      Error);
}

}  // namespace
}  // namespace cellwalk::io
