// SPDX-License-Identifier: LGPL-3.0-or-later
// The files of one mesh.
#ifndef CELLWALK_INTERNAL_IO_MESH_FILES_H
#define CELLWALK_INTERNAL_IO_MESH_FILES_H

#include <filesystem>
#include <vector>

namespace cellwalk::io {

/// The files that are read for a mesh: mostly the one that is named, but those of the folder for OpenFOAM,
/// and for Triangle's .poly the .node beside it. None for a folder without a mesh.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& mesh);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_MESH_FILES_H
