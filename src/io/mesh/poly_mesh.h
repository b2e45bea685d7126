// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a mesh of OpenFOAM, which is a folder `polyMesh` of several files.
#ifndef CELLWALK_IO_MESH_POLY_MESH_H
#define CELLWALK_IO_MESH_POLY_MESH_H

#include <cellwalk/io/mesh_file.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk::io {

/// A file in memory.
struct Named_bytes {
  std::string name;  ///< in errors
  std::string bytes;
};

/// The files of a mesh; zones may be missing.
struct Poly_mesh_files {
  Named_bytes points, faces, owner, neighbour, boundary;
  std::optional<Named_bytes> face_zones, cell_zones;
};

/// The folder of the mesh that a path names: the folder itself, that of a case or its `constant`, one of the
/// files, or a file CASE.foam as ParaView opens it. None if the path is a file of another name.
/// \throw Error(input) for a folder without such a mesh
std::optional<std::filesystem::path> poly_mesh_folder(const std::filesystem::path& path);

/// Those that are read and are there.
std::vector<std::filesystem::path> files_of_poly_mesh(const std::filesystem::path& folder);

/// \throw Error(input) with the file, and the line or byte
Mesh_file read_poly_mesh(const std::filesystem::path& folder);

/// Faces between two cells are passable, and all others walls, also where two have the same points. Patches
/// of the boundary and zones are groups.
/// \throw Error(input) as read_poly_mesh()
Mesh_file parse_poly_mesh(const Poly_mesh_files& files);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_POLY_MESH_H
