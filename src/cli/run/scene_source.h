// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene for `cellwalk run`: a file or the built-in one, with the changes of the command line.
#ifndef CELLWALK_CLI_RUN_SCENE_SOURCE_H
#define CELLWALK_CLI_RUN_SCENE_SOURCE_H

#include <cellwalk/internal/records/scene.h>

#include <string>
#include <vector>

namespace cellwalk::cli {

struct Scene_source {
  std::string name;  ///< as in messages of errors
  std::string text;  ///< JSON, maybe with comments
  Any_scene scene;
};

/// Reads a scene, or takes the one built in (data/hexahedra.json) where no file is named.
/// \throw Error as io::change_scene and
/// io::read_scene
Scene_source load_scene(const std::string& path, const std::vector<std::string>& changes);

/// The content of data/hexahedra.json.
extern const char* const built_in_scene;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_SCENE_SOURCE_H
