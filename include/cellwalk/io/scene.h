// SPDX-License-Identifier: LGPL-3.0-or-later
// Scene files: JSON, every key checked. The format is described in docs/scenes.md.
#ifndef CELLWALK_IO_SCENE_H
#define CELLWALK_IO_SCENE_H

#include <cellwalk/records/scene.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads a scene. Nothing is guessed: unknown, repeated and missing keys, wrong types and values out of range are
/// refused. File names of environments and bodies are resolved against the scene's folder.
/// \throw Error(input) `FILE: key.path[2].key: what is wrong`, or `FILE:LINE: ...` where the file is not JSON
Any_scene read_scene(const std::filesystem::path& path);

/// The bytes of a scene file, inflated where it is compressed with gzip. \throw Error(input) if it cannot be read
std::string scene_text(const std::filesystem::path& path);

/// The same from text in memory; `name` stands for the file in errors. Names of files are resolved against the folder; without
/// one they stay as written.
Any_scene parse_scene(const std::string& name, std::string_view text,
                      const std::filesystem::path& folder = {});

/// Text of a scene with some values replaced. A change is `KEY=VALUE`: the key as errors name it (`environment.cells`,
/// `bodies[0].count`), the value as JSON has it, or a text without its quotes. What is missing on the way to a key is made; elements
/// of lists must be there. Whether the scene makes sense is not checked here. Comments are lost.
/// \throw Error(usage) naming the change; Error(input) where the text is not JSON
std::string change_scene(const std::string& name, std::string_view text,
                         std::span<const std::string> changes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_SCENE_H
