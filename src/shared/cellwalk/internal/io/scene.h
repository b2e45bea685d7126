// SPDX-License-Identifier: LGPL-3.0-or-later
// Scene files: JSON, with all keys checked. The format is described in docs/scenes.md.
#ifndef CELLWALK_INTERNAL_IO_SCENE_H
#define CELLWALK_INTERNAL_IO_SCENE_H

#include <cellwalk/internal/records/scene.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads a scene. Unknown, repeated and missing keys, wrong types and values out of range are
/// refused. File names of environments and bodies are resolved against the scene's folder.
/// \throw Error(input) `FILE: key.path[2].key: problem`, or `FILE:LINE: ...` if the file is not JSON
Any_scene read_scene(const std::filesystem::path& path);

/// The bytes of a scene file, inflated if it is compressed with gzip.
/// \throw Error(input) if it cannot be read
std::string scene_text(const std::filesystem::path& path);

/// Reads from text in memory.
/// \param name stands for the file in errors
/// \param folder the base of relative file names; empty: they are not resolved
Any_scene parse_scene(const std::string& name, std::string_view text,
                      const std::filesystem::path& folder = {});

/// Text of a scene with some values replaced. A change is `KEY=VALUE`, with the key as in error messages
/// (`environment.cells`, `bodies[0].count`) and the value in JSON, or a text without quotes. Missing parents
/// of a key are created; elements of lists must exist. The scene is not checked. Comments are lost.
/// \throw Error(usage) naming the change; Error(input) if the text is not JSON
std::string change_scene(const std::string& name, std::string_view text,
                         std::span<const std::string> changes);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_SCENE_H
