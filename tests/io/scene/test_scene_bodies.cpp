// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/scene.h>

#include <gtest/gtest.h>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

template <int D>
std::string scene_with(const std::string& bodies) {
  return R"({"dimension": )" + std::to_string(D) + R"(, "environment": "e", "steps": 1, "bodies": [)" +
         bodies + "]}";
}

template <int D>
std::vector<Body_start<D>> bodies(const std::string& text) {
  return std::get<Scene<D>>(parse_scene("s.json", scene_with<D>(text))).bodies;
}

template <int D>
std::string said_of(const std::string& text) {
  return refusal([&] { parse_scene("s.json", scene_with<D>(text)); });
}

/// The shape of the only body.
template <class Shape, int D>
Shape shape(const std::string& text) {
  return std::get<Shape>(std::get<Body_shape<D>>(bodies<D>(text).at(0).source));
}

TEST(SceneBodies, ReadsEveryKey) {
  const auto found = bodies<3>(R"(
    {"file": "sub/b.obj", "position": [1, 2, 3], "scale": 0.5,
     "rotation": {"axis": [0, 1, 2], "degrees": -30}, "velocity": [0, 0, 4],
     "spin": [0.25, 0, 1], "motion": "thrown"},
    {"shape": "hexahedron", "side": 0.3, "count": 225, "seed": 8, "speed": 3, "spin": [0, 0, 1]},
    {"shape": "icosphere", "motion": {"path": [[0, 0, 1], [1, 0, 1], [1, 1, 1]], "speed": 2}})");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(std::get<std::string>(found[0].source), "sub/b.obj");
  EXPECT_EQ(found[0].placement.position, (Point<3>{1, 2, 3}));
  EXPECT_EQ(found[0].placement.scale, 0.5);
  EXPECT_EQ(found[0].placement.rotation.axis, (Vector<3>{0, 1, 2}));
  EXPECT_EQ(found[0].placement.rotation.degrees, -30);
  EXPECT_EQ(found[0].velocity, (Vector<3>{0, 0, 4}));
  EXPECT_EQ(found[0].spin, (Spin<3>{0.25, 0, 1}));
  EXPECT_FALSE(found[0].cloud);
  EXPECT_FALSE(found[0].guided);
  ASSERT_TRUE(found[1].cloud);
  EXPECT_EQ(found[1].cloud->count, 225u);
  EXPECT_EQ(found[1].cloud->seed, 8u);
  EXPECT_EQ(found[1].cloud->speed, 3);
  ASSERT_TRUE(found[2].guided);
  EXPECT_EQ(found[2].guided->path, (std::vector<Point<3>>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(found[2].guided->speed, 2);
  EXPECT_EQ(found[2].placement.position, (Point<3>{0, 0, 1}));
}

TEST(SceneBodies, ReadsMaterials) {
  const auto found = bodies<3>(R"({"shape": "box"}, {"shape": "box", "material": {}},
    {"file": "a.off", "material": {"model": "shape_matching", "mode": "linear", "stiffness": 0.25,
                                   "deformation": 0.75, "volume": false}},
    {"shape": "box", "count": 3, "material": {"mode": "quadratic", "deformation": 1}})");
  ASSERT_EQ(found.size(), 4u);
  EXPECT_FALSE(found[0].material);
  ASSERT_TRUE(found[1].material && found[2].material && found[3].material);
  EXPECT_EQ(found[1].material->mode, Shape_mode::rigid);
  EXPECT_EQ(found[1].material->stiffness, 1);
  EXPECT_EQ(found[2].material->mode, Shape_mode::linear);
  EXPECT_EQ(found[2].material->stiffness, 0.25);
  EXPECT_EQ(found[2].material->deformation, 0.75);
  EXPECT_FALSE(found[2].material->keeps_volume);
  EXPECT_EQ(found[3].material->mode, Shape_mode::quadratic);
  EXPECT_EQ(found[3].material->deformation, 1);
  EXPECT_TRUE(found[3].material->keeps_volume);
}

TEST(SceneBodies, HasDefaults) {
  const auto body = bodies<3>(R"({"shape": "hexahedron", "count": 2})").at(0);
  EXPECT_EQ(body.placement.scale, 1);
  EXPECT_EQ(body.placement.rotation.degrees, 0);
  EXPECT_EQ(body.placement.position, (Point<3>{}));
  EXPECT_EQ(body.velocity, (Vector<3>{}));
  EXPECT_EQ(body.spin, (Spin<3>{}));
  EXPECT_FALSE(body.guided);
  EXPECT_EQ(body.cloud->seed, 1u);
  EXPECT_EQ(body.cloud->speed, 0);
}

TEST(SceneBodies, ReadsThePlane) {
  const auto body = bodies<2>(R"({"shape": "quad", "side": 2, "position": [1, 2], "rotation": {"degrees": 45},
    "velocity": [3, 4], "spin": -0.5})")
                        .at(0);
  EXPECT_EQ(body.placement.position, (Point<2>{1, 2}));
  EXPECT_EQ(body.placement.rotation.degrees, 45);
  EXPECT_EQ(body.velocity, (Vector<2>{3, 4}));
  EXPECT_EQ(body.spin, (Spin<2>{-0.5}));
  EXPECT_EQ((shape<Quad_shape, 2>(R"({"shape": "quad", "side": 2})").side), 2);
  EXPECT_EQ((shape<Triangle_shape, 2>(R"({"shape": "triangle", "side": 3})").side), 3);
  const auto polygon = shape<Polygon_shape, 2>(R"({"shape": "polygon", "corners": 7, "radius": 0.5})");
  EXPECT_EQ(polygon.corners, 7u);
  EXPECT_EQ(polygon.radius, 0.5);
  EXPECT_EQ((shape<Catheter_shape<2>, 2>(R"({"shape": "catheter", "length": 9})").length), 9);
  EXPECT_EQ((shape<Polyline_shape<2>, 2>(R"({"shape": "polyline", "points": [[0, 1], [2, 3]]})").points),
            (std::vector<Point<2>>{{0, 1}, {2, 3}}));
}

TEST(SceneBodies, ReadsTheShapesOfSpace) {
  const auto hexahedron =
      shape<Hexahedron_shape, 3>(R"({"shape": "hexahedron", "side": 0.3, "faces": true})");
  EXPECT_EQ(hexahedron.side, 0.3);
  EXPECT_TRUE(hexahedron.faces);
  const auto box =
      shape<Box_shape, 3>(R"({"shape": "box", "size": [1, 2, 3], "cells": [4, 5, 6], "faces": true})");
  EXPECT_EQ(box.size, (Vector<3>{1, 2, 3}));
  EXPECT_EQ(box.cells, (std::array<std::uint32_t, 3>{4, 5, 6}));
  EXPECT_TRUE(box.faces);
  EXPECT_FALSE((shape<Box_shape, 3>(R"({"shape": "box"})").faces));
  EXPECT_EQ((shape<Tetrahedron_shape, 3>(R"({"shape": "tetrahedron", "side": 2})").side), 2);
  const auto sphere = shape<Icosphere_shape, 3>(R"({"shape": "icosphere", "radius": 2, "subdivisions": 0})");
  EXPECT_EQ(sphere.radius, 2);
  EXPECT_EQ(sphere.subdivisions, 0u);
  const auto catheter = shape<Catheter_shape<3>, 3>(R"({"shape": "catheter", "length": 2, "vertices": 50})");
  EXPECT_EQ(catheter.length, 2);
  EXPECT_EQ(catheter.vertices, 50u);
  EXPECT_EQ((shape<Polyline_shape<3>, 3>(R"({"shape": "polyline", "points": [[0, 1, 2]]})").points),
            (std::vector<Point<3>>{{0, 1, 2}}));
}

TEST(SceneBodies, ResolvesFilesAgainstTheFolderOfTheScene) {
  const Folder folder;
  const auto path = folder.write("s.json", scene_with<3>(R"({"shape": "box"}, {"file": "sub/b.obj"})"));
  const auto scene = std::get<Scene<3>>(read_scene(path));
  EXPECT_EQ(std::get<std::string>(scene.bodies.at(1).source), (folder / "sub/b.obj").string());
  EXPECT_EQ(std::get<std::string>(scene.environment), (folder / "e").string());
}

struct Body_refusal {
  const char *text, *message;
};

const Body_refusal of_space[] = {
    {"1", "bodies[0]: expected an object {...}"},
    {"{}", "bodies[0]: expected either \"file\" or \"shape\""},
    {R"({"file": "a", "shape": "box"})", "bodies[0]: expected either \"file\" or \"shape\""},
    {R"({"file": ""})", "bodies[0].file: expected the name of a file"},
    {R"({"file": 1})", "bodies[0].file: expected a text"},
    {R"({"shape": "cube"})",
     "bodies[0].shape: 'cube' is no shape of dimension 3; known are box, catheter, hexahedron, icosphere, "
     "polyline, "
     "tetrahedron"},
    {R"({"shape": "quad"})",
     "bodies[0].shape: 'quad' is no shape of dimension 3; known are box, catheter, hexahedron, icosphere, "
     "polyline, "
     "tetrahedron"},
    {R"({"shape": "box"}, {"shape": "tetrahedron", "radius": 1})",
     "bodies[1].radius: unknown key; known here: count, edge_radius, file, material, motion, position, "
     "rotation, scale, "
     "seed, shape, side, "
     "speed, spin, velocity"},
    {R"({"file": "a", "side": 1})",
     "bodies[0].side: unknown key; known here: count, edge_radius, file, material, motion, position, "
     "rotation, scale, "
     "seed, "
     "shape, speed, "
     "spin, velocity"},
    {R"({"shape": "hexahedron", "side": 0})", "bodies[0].side: expected a number greater than 0, not 0"},
    {R"({"shape": "hexahedron", "faces": 1})", "bodies[0].faces: expected true or false"},
    {R"({"shape": "box", "size": 1})", "bodies[0].size: expected 3 numbers"},
    {R"({"shape": "box", "size": [1, -1, 1]})",
     "bodies[0].size[1]: expected a number greater than 0, not -1"},
    {R"({"shape": "box", "cells": [1, 1]})", "bodies[0].cells: expected 3 integers"},
    {R"({"shape": "box", "cells": [1, 0, 1]})",
     "bodies[0].cells[1]: expected an integer from 1 to 16777216, not 0"},
    {R"({"shape": "icosphere", "subdivisions": 11})",
     "bodies[0].subdivisions: expected an integer from 0 to 10, not 11"},
    {R"({"shape": "catheter", "vertices": 1})",
     "bodies[0].vertices: expected an integer from 2 to 16777216, not 1"},
    {R"({"shape": "polyline"})", "bodies[0]: key \"points\" is missing"},
    {R"({"shape": "polyline", "points": []})", "bodies[0].points: expected at least 1 point"},
    {R"({"shape": "polyline", "points": [[1, 2]]})", "bodies[0].points[0]: expected 3 numbers"},
    {R"({"file": "a", "scale": -1})", "bodies[0].scale: expected a number greater than 0, not -1"},
    {R"({"file": "a", "position": [1, 2]})", "bodies[0].position: expected 3 numbers"},
    {R"({"file": "a", "velocity": 1})", "bodies[0].velocity: expected 3 numbers"},
    {R"({"file": "a", "spin": 1})", "bodies[0].spin: expected 3 numbers"},
    {R"({"file": "a", "rotation": 90})", "bodies[0].rotation: expected an object {...}"},
    {R"({"file": "a", "rotation": {"degrees": 90}})", "bodies[0].rotation: key \"axis\" is missing"},
    {R"({"file": "a", "rotation": {"axis": [0, 0, 1]}})", "bodies[0].rotation: key \"degrees\" is missing"},
    {R"({"file": "a", "rotation": {"axis": [0, 0, -0], "degrees": 1}})",
     "bodies[0].rotation.axis: an axis cannot be zero"},
    {R"({"file": "a", "count": 0})", "bodies[0].count: expected an integer from 1 to 10000000, not 0"},
    {R"({"file": "a", "seed": 1})", "bodies[0].seed: only for random bodies: give \"count\" as well"},
    {R"({"file": "a", "speed": 1})", "bodies[0].speed: only for random bodies: give \"count\" as well"},
    {R"({"file": "a", "count": 1, "velocity": [0, 0, 0]})",
     "bodies[0].velocity: not for random bodies, which have \"seed\" and \"speed\""},
    {R"({"file": "a", "count": 1, "position": [0, 0, 0]})",
     "bodies[0].position: not for random bodies, which have \"seed\" and \"speed\""},
    {R"({"file": "a", "motion": "free"})",
     R"(bodies[0].motion: expected "thrown" or {"path": ..., "speed": ...})"},
    {R"({"file": "a", "motion": 1})",
     R"(bodies[0].motion: expected "thrown" or {"path": ..., "speed": ...})"},
    {R"({"file": "a", "motion": {"path": [[0, 0, 0], [1, 0, 0]]}})",
     "bodies[0].motion: key \"speed\" is missing"},
    {R"({"file": "a", "motion": {"path": [[0, 0, 0]], "speed": 1}})",
     "bodies[0].motion.path: expected at least 2 waypoints"},
    {R"({"file": "a", "motion": {"path": [[0, 0, 0], [0, 0, 0]], "speed": 1}})",
     "bodies[0].motion.path[1]: the same waypoint twice in a row"},
    {R"({"file": "a", "motion": {"path": [[0, 0, 0], [1, 0, 0]], "speed": 0}})",
     "bodies[0].motion.speed: expected a number greater than 0, not 0"},
    {R"({"file": "a", "count": 3, "motion": {"path": [[0, 0, 0], [1, 0, 0]], "speed": 1}})",
     "bodies[0].count: not for a body on a path, which starts at the first waypoint"},
    {R"({"file": "a", "material": "rubber"})", "bodies[0].material: expected an object {...}"},
    {R"({"file": "a", "material": {"model": "fem"}})",
     "bodies[0].material.model: expected \"shape_matching\""},
    {R"({"file": "a", "material": {"mode": "cubic"}})",
     "bodies[0].material.mode: expected \"rigid\", \"linear\" or \"quadratic\""},
    {R"({"file": "a", "material": {"mode": 1}})", "bodies[0].material.mode: expected a text"},
    {R"({"file": "a", "material": {"stiffness": 0}})",
     "bodies[0].material.stiffness: expected a number greater than 0: without stiffness there is no body"},
    {R"({"file": "a", "material": {"stiffness": 1.5}})",
     "bodies[0].material.stiffness: expected a number from 0 to 1, not 1.5"},
    {R"({"file": "a", "material": {"deformation": 0.5}})",
     "bodies[0].material.deformation: unknown key; known here: mode, model, stiffness"},
    {R"({"file": "a", "material": {"mode": "linear", "deformation": -1}})",
     "bodies[0].material.deformation: expected a number from 0 to 1, not -1"},
    {R"({"file": "a", "material": {"mode": "linear", "volume": 1}})",
     "bodies[0].material.volume: expected true or false"},
    {R"({"file": "a", "material": {"mode": "quadratic", "volume": true}})",
     "bodies[0].material.volume: unknown key; known here: deformation, mode, model, stiffness"},
    {R"({"file": "a", "material": {}, "motion": {"path": [[0, 0, 0], [1, 0, 0]], "speed": 1}})",
     "bodies[0].material: not for a body on a path, which is rigid"},
    {R"({"file": "a", "position": [0, 0, 0], "motion": {"path": [[0, 0, 0], [1, 0, 0]], "speed": 1}})",
     "bodies[0].position: not for a body on a path, which starts at the first waypoint"},
};

TEST(SceneBodies, RefusesWithTheKeyThatIsWrong) {
  for (const Body_refusal& r : of_space)
    EXPECT_EQ(said_of<3>(r.text), std::string("s.json: ") + r.message) << r.text;
  EXPECT_EQ(said_of<2>(R"({"shape": "box"})"),
            "s.json: bodies[0].shape: 'box' is no shape of dimension 2; known are catheter, polygon, "
            "polyline, quad, "
            "triangle");
  EXPECT_EQ(said_of<2>(R"({"shape": "polygon", "corners": 2})"),
            "s.json: bodies[0].corners: expected an integer from 3 to 16777216, not 2");
  EXPECT_EQ(said_of<2>(R"({"shape": "quad", "spin": [1, 2, 3]})"),
            "s.json: bodies[0].spin: expected a number");
  EXPECT_EQ(said_of<2>(R"({"shape": "quad", "rotation": {"axis": [0, 0, 1], "degrees": 1}})"),
            "s.json: bodies[0].rotation.axis: unknown key; known here: degrees");
  EXPECT_EQ(refusal([] { parse_scene("s.json", R"({"environment": "e", "bodies": {}})"); }),
            "s.json: bodies: expected a list [...]");
}

}  // namespace
}  // namespace cellwalk::io
