// SPDX-License-Identifier: LGPL-3.0-or-later
// The text of a scene, with the changes of the command line applied before it is parsed.
#include "scene_source.h"

#include <cellwalk/internal/io/scene.h>

#include <filesystem>

namespace cellwalk::cli {

Scene_source load_scene(const std::string& path, const std::vector<std::string>& changes) {
  Scene_source source;
  source.name = path.empty() ? "hexahedra.json (built in)" : path;
  source.text = path.empty() ? built_in_scene : io::scene_text(path);
  if (!changes.empty()) source.text = io::change_scene(source.name, source.text, changes);
  source.scene = io::parse_scene(source.name, source.text, std::filesystem::path(path).parent_path());
  return source;
}

}  // namespace cellwalk::cli
