// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scenes.h"

#include <cellwalk/internal/generators/body_of_shape.h>
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/internal/loading/generators.h>

#include <filesystem>
#include <utility>
#include <variant>

namespace cellwalk::scaling {
namespace {

Scene<3> read(const Scene_entry& entry) {
  const std::filesystem::path path = std::filesystem::path(CELLWALK_SCENES) / entry.file;
  const std::string text = io::change_scene(entry.file, io::scene_text(path), entry.changes);
  return std::get<Scene<3>>(io::parse_scene(entry.file, text, path.parent_path()));
}

Environment<3> build(const Scene<3>& scene) {
  const auto& call = std::get<Generator_call>(scene.environment);
  Build_options options = build_of_generated;
  options.keep_map = false;
  return Environment<3>::build(std::get<Cell_soup<3>>(generate(call.generator, call.options)), options);
}

std::vector<Body_soup<3>> shapes(const Scene<3>& scene) {
  std::vector<Body_soup<3>> all;
  for (const Body_start<3>& start : scene.bodies)
    all.push_back(generate_body(std::get<Body_shape<3>>(start.source)));
  return all;
}

}  // namespace

std::vector<Scene_entry> all_scenes(bool quick) {
  if (quick)
    return {{"hexahedra", "hexahedra.json", {"bodies[0].count=40"}, 20},
            {"catheter", "catheter.json", {"catheter.radius=0"}, 60},
            {"particles", "vessel.json", {"particles[0].count=300", "catheter.radius=0"}, 20}};
  return {{"hexahedra", "hexahedra.json", {"environment.cells=60", "bodies[0].count=10000"}, 200},
          {"larger hexahedra",
           "hexahedra.json",
           {"environment.cells=60", "bodies[0].count=10000", "bodies[0].side=0.9"},
           200},
          {"catheter", "catheter.json", {"catheter.radius=0"}, 300},
          {"particles", "vessel.json", {"particles[0].count=100000", "catheter.radius=0"}, 200}};
}

Running_scene::Running_scene(const Scene_entry& entry)
    : scene_(read(entry)),
      environment_(build(scene_)),
      world_(environment_.snapshot(), scene_, shapes(scene_)) {}

}  // namespace cellwalk::scaling
