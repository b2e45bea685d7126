// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scenes.h"

#include <cellwalk/internal/io/scene.h>
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <utility>
#include <variant>

namespace cellwalk::real_scenes {
namespace {

Cell_soup<3> read_cells(const std::filesystem::path& path) {
  io::Mesh_file file = io::read_mesh(path.string());
  if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh)) return std::move(*soup);
  throw Error(Error_code::input, fmt::format("{}: holds no 3D cells", path.string()));
}

void check_share(const Scene_entry& entry, const Motion& motion) {
  const double share =
      static_cast<double>(std::ranges::count(motion.blocked, 1)) / static_cast<double>(motion.blocked.size());
  if (share < entry.least_blocked)
    throw Error(Error_code::input,
                fmt::format("{}: walls block {:.2f} % of the moves; this scene is to have at least {:g} %",
                            entry.name, 100 * share, 100 * entry.least_blocked));
}

}  // namespace

std::vector<Scene_entry> read_scene_list(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw Error(Error_code::input, fmt::format("{}: cannot be read", path.string()));
  const std::filesystem::path folder = path.parent_path();
  std::vector<Scene_entry> entries;
  for (const nlohmann::json& item : nlohmann::json::parse(file)) {
    Scene_entry entry{item.at("name"),
                      folder / item.at("scene").get<std::string>(),
                      {},
                      folder / item.at("trace").get<std::string>(),
                      item.at("first_step")};
    entry.least_blocked = item.value("least_blocked", 0.0);
    if (item.contains("environment")) entry.environment = folder / item.at("environment").get<std::string>();
    entries.push_back(std::move(entry));
  }
  return entries;
}

Cell_soup<3> load_cells(const Scene_entry& entry) {
  if (!entry.environment.empty()) return read_cells(entry.environment);
  const Any_scene any = io::read_scene(entry.scene);
  const auto* scene = std::get_if<Scene<3>>(&any);
  if (!scene) throw Error(Error_code::input, fmt::format("{}: is 2D", entry.scene.string()));
  if (const auto* file = std::get_if<std::string>(&scene->environment)) return read_cells(*file);
  const auto& call = std::get<Generator_call>(scene->environment);
  return std::get<Cell_soup<3>>(generate(call.generator, call.options));
}

Loaded_scene load_scene(const Scene_entry& entry) {
  Body_trace trace = io::read_trace(entry.trace);
  if (trace.answers.empty() || entry.first_step >= trace.steps)
    throw Error(Error_code::input,
                fmt::format("{}: holds no answers, or no step {}", entry.trace.string(), entry.first_step));
  Loaded_scene scene{load_cells(entry), {}, make_motion(std::move(trace), entry.first_step)};
  check_share(entry, scene.motion);
  scene.gluing = glue(scene.soup);
  return scene;
}

}  // namespace cellwalk::real_scenes
