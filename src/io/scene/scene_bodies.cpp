// SPDX-License-Identifier: LGPL-3.0-or-later
// Shapes by name with their keys, and the starts, motions and materials of bodies.
#include "scene_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "io/files/text.h"

namespace cellwalk::io::detail {
namespace {

constexpr std::uint64_t most_vertices = 1 << 24, most_subdivisions = 10;  // as the generators have them
constexpr std::uint64_t largest_seed = std::uint64_t{1} << 53;            // kept exactly by every JSON reader
constexpr double largest_speed = 1e300;                                   // units a second

double positive(const Json_node& node, std::string_view key, double otherwise) {
  const auto given = node.find(key);
  return given ? given->positive() : otherwise;
}

std::uint32_t integer(const Json_node& node, std::string_view key, std::uint64_t low, std::uint64_t high,
                      std::uint32_t otherwise) {
  const auto given = node.find(key);
  return given ? static_cast<std::uint32_t>(given->integer_in(low, high)) : otherwise;
}

bool flag(const Json_node& node, std::string_view key) {
  const auto given = node.find(key);
  return given && given->boolean();
}

Box_shape box(const Json_node& node) {
  Box_shape shape;
  if (const auto size = node.find("size")) {
    shape.size = size->tuple<3>();
    for (const Json_node& s : size->elements()) s.positive();
  }
  if (const auto cells = node.find("cells")) {
    const std::vector<Json_node> counts = cells->elements();
    if (counts.size() != 3) cells->fail("expected 3 integers");
    for (std::size_t k = 0; k < 3; ++k)
      shape.cells[k] = static_cast<std::uint32_t>(counts[k].integer_in(1, most_vertices));
  }
  shape.faces = flag(node, "faces");
  return shape;
}

template <int D>
Catheter_shape<D> catheter(const Json_node& node) {
  const Catheter_shape<D> shape;
  return {positive(node, "length", shape.length),
          integer(node, "vertices", 2, most_vertices, shape.vertices)};
}

template <int D>
Polyline_shape<D> polyline(const Json_node& node) {
  Polyline_shape<D> shape;
  for (const Json_node& point : node.at("points").elements()) shape.points.push_back(point.tuple<D>());
  if (shape.points.empty()) node.at("points").fail("expected at least 1 point");
  return shape;
}

/// A shape by its name, with its own keys.
template <int D>
struct Known_shape {
  std::string_view name;
  std::vector<std::string_view> keys;
  Body_shape<D> (*read)(const Json_node& node);
};

template <int D>
const std::vector<Known_shape<D>>& known_shapes();

template <>
const std::vector<Known_shape<2>>& known_shapes<2>() {
  using Shape = Body_shape<2>;
  using Node = const Json_node&;
  static const std::vector<Known_shape<2>> shapes{
      {"catheter", {"length", "vertices"}, [](Node node) -> Shape { return catheter<2>(node); }},
      {"polygon",
       {"corners", "radius"},
       [](Node node) -> Shape {
         return Polygon_shape{integer(node, "corners", 3, most_vertices, Polygon_shape{}.corners),
                              positive(node, "radius", Polygon_shape{}.radius)};
       }},
      {"polyline", {"points"}, [](Node node) -> Shape { return polyline<2>(node); }},
      {"quad",
       {"side"},
       [](Node node) -> Shape { return Quad_shape{positive(node, "side", Quad_shape{}.side)}; }},
      {"triangle", {"side"}, [](Node node) -> Shape {
         return Triangle_shape{positive(node, "side", Triangle_shape{}.side)};
       }}};
  return shapes;
}

template <>
const std::vector<Known_shape<3>>& known_shapes<3>() {
  using Shape = Body_shape<3>;
  using Node = const Json_node&;
  static const std::vector<Known_shape<3>> shapes{
      {"box", {"size", "cells", "faces"}, [](Node node) -> Shape { return box(node); }},
      {"catheter", {"length", "vertices"}, [](Node node) -> Shape { return catheter<3>(node); }},
      {"hexahedron",
       {"side", "faces"},
       [](Node node) -> Shape {
         return Hexahedron_shape{positive(node, "side", Hexahedron_shape{}.side), flag(node, "faces")};
       }},
      {"icosphere",
       {"radius", "subdivisions"},
       [](Node node) -> Shape {
         return Icosphere_shape{
             positive(node, "radius", Icosphere_shape{}.radius),
             integer(node, "subdivisions", 0, most_subdivisions, Icosphere_shape{}.subdivisions)};
       }},
      {"polyline", {"points"}, [](Node node) -> Shape { return polyline<3>(node); }},
      {"tetrahedron", {"side"}, [](Node node) -> Shape {
         return Tetrahedron_shape{positive(node, "side", Tetrahedron_shape{}.side)};
       }}};
  return shapes;
}

template <int D>
Body_source<D> source(const Json_node& node) {
  std::vector<std::string_view> keys{"file",  "shape", "position", "scale",  "rotation", "velocity",   "spin",
                                     "count", "seed",  "speed",    "motion", "material", "edge_radius"};
  if (node.has("file") == node.has("shape")) node.fail("expected either \"file\" or \"shape\"");
  if (const auto file = node.find("file")) {
    node.expect_keys(keys);
    if (file->string().empty()) file->fail("expected the name of a file");
    return file->string();
  }
  const std::vector<Known_shape<D>>& known = known_shapes<D>();
  const Json_node shape = node.at("shape");
  const std::string name = shape.string();
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.name == name; });
  if (found == known.end()) {
    std::vector<std::string_view> names;
    names.reserve(known.size());
    for (const auto& k : known) names.push_back(k.name);
    shape.fail(fmt::format("'{}' is no shape of dimension {}; known are {}", shown(name), D,
                           fmt::join(names, ", ")));
  }
  keys.insert(keys.end(), found->keys.begin(), found->keys.end());
  node.expect_keys(keys);
  return found->read(node);
}

template <int D>
Rotation<D> rotation(const Json_node& node) {
  if constexpr (D == 2) {
    node.expect_keys({"degrees"});
    return {node.at("degrees").number()};
  } else {
    node.expect_keys({"axis", "degrees"});
    const Json_node axis = node.at("axis");
    const Rotation<3> result{axis.tuple<3>(), node.at("degrees").number()};
    if (result.axis == Vector<3>{}) axis.fail("an axis cannot be zero");
    return result;
  }
}

template <int D>
Guided_motion<D> guided_motion(const Json_node& node) {
  node.expect_keys({"path", "speed"});
  return {waypoints<D>(node.at("path")), node.at("speed").positive()};
}

Shape_material material(const Json_node& node) {
  Shape_material result;
  if (const auto model = node.find("model"); model && model->string() != "shape_matching")
    model->fail("expected \"shape_matching\"");
  const std::string mode = node.has("mode") ? node.at("mode").string() : "rigid";
  const std::string_view modes[] = {"rigid", "linear", "quadratic"};
  const auto* found = std::ranges::find(modes, mode);
  if (found == std::end(modes)) node.at("mode").fail("expected \"rigid\", \"linear\" or \"quadratic\"");
  result.mode = static_cast<Shape_mode>(found - modes);
  std::vector<std::string_view> keys{"model", "mode", "stiffness"};
  if (result.mode != Shape_mode::rigid) keys.push_back("deformation");
  if (result.mode == Shape_mode::linear) keys.push_back("volume");
  node.expect_keys(keys);
  if (const auto stiffness = node.find("stiffness")) {
    result.stiffness = stiffness->number_in(0, 1);
    if (result.stiffness == 0)
      stiffness->fail("expected a number greater than 0: without stiffness there is no body");
  }
  if (const auto deformation = node.find("deformation")) result.deformation = deformation->number_in(0, 1);
  if (const auto volume = node.find("volume")) result.keeps_volume = volume->boolean();
  return result;
}

/// Refuses keys that contradict another one.
void refuse_beside(const Json_node& node, std::initializer_list<const char*> keys, const std::string& why) {
  for (const char* key : keys)
    if (const auto extra = node.find(key)) extra->fail(why);
}

}  // namespace

Particle_cloud cloud(const Json_node& node) {
  Particle_cloud result;
  result.count = static_cast<std::uint32_t>(node.at("count").integer_in(1, most_particles));
  if (const auto seed = node.find("seed")) result.seed = seed->integer_in(0, largest_seed);
  if (const auto speed = node.find("speed")) result.speed = speed->number_in(0, largest_speed);
  return result;
}

template <int D>
std::vector<Point<D>> waypoints(const Json_node& node) {
  std::vector<Point<D>> path;
  for (const Json_node& point : node.elements()) {
    path.push_back(point.tuple<D>());
    if (path.size() > 1 && path.back() == path[path.size() - 2])
      point.fail("the same waypoint twice in a row");
  }
  if (path.size() < 2) node.fail("expected at least 2 waypoints");
  return path;
}

template <int D>
Body_start<D> body_start(const Json_node& node) {
  Body_start<D> start;
  start.source = source<D>(node);
  if (const auto scale = node.find("scale")) start.placement.scale = scale->positive();
  if (const auto r = node.find("rotation")) start.placement.rotation = rotation<D>(*r);
  if (const auto position = node.find("position")) start.placement.position = position->tuple<D>();
  if (const auto velocity = node.find("velocity")) start.velocity = velocity->tuple<D>();
  if (const auto spin = node.find("spin")) {
    if constexpr (D == 2)
      start.spin = {spin->number()};
    else
      start.spin = spin->tuple<3>();
  }
  if (const auto motion = node.find("motion")) {
    if (motion->is_object())
      start.guided = guided_motion<D>(*motion);
    else if (!motion->is_string() || motion->string() != "thrown")
      motion->fail("expected \"thrown\" or {\"path\": ..., \"speed\": ...}");
  }
  if (const auto m = node.find("material")) start.material = material(*m);
  if (const auto r = node.find("edge_radius")) start.edge_radius = r->number_in(0, largest_radius);
  if (start.guided) {
    refuse_beside(node, {"material"}, "not for a body on a path, which is rigid");
    refuse_beside(node, {"position", "velocity", "count", "seed", "speed"},
                  "not for a body on a path, which starts at the first waypoint");
    start.placement.position = start.guided->path[0];
  }
  if (node.has("count")) {
    refuse_beside(node, {"position", "velocity"}, "not for random bodies, which have \"seed\" and \"speed\"");
    start.cloud = cloud(node);
  } else {
    refuse_beside(node, {"seed", "speed"}, "only for random bodies: give \"count\" as well");
  }
  return start;
}

template Body_start<2> body_start(const Json_node&);
template Body_start<3> body_start(const Json_node&);
template std::vector<Point<2>> waypoints<2>(const Json_node&);
template std::vector<Point<3>> waypoints<3>(const Json_node&);

}  // namespace cellwalk::io::detail
