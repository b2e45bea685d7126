// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/scene_source.h"

#include <cellwalk/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace cellwalk::cli {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(Error_code::input, path + ": cannot be read; check the name and its permissions");
  return text;
}

}  // namespace

Scene_source load_scene(const std::string& path, const std::vector<std::string>& changes) {
  Scene_source source;
  source.name = path.empty() ? "hexahedra.json (built in)" : path;
  source.text = path.empty() ? built_in_scene : text_of(path);
  if (!changes.empty()) source.text = io::change_scene(source.name, source.text, changes);
  source.scene = io::parse_scene(source.name, source.text, std::filesystem::path(path).parent_path());
  return source;
}

}  // namespace cellwalk::cli
