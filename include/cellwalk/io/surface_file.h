// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces: polygon soups from OFF, OBJ, STL and PLY.
#ifndef CELLWALK_IO_SURFACE_FILE_H
#define CELLWALK_IO_SURFACE_FILE_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/surface_soup.h>

#include <filesystem>

namespace cellwalk::io {

/// Reads a surface. The polygons are unchanged; meshing checks whether they are closed, oriented and
/// manifold. The format is determined by the extension, which may be followed by `.gz`. STL corners of equal
/// coordinates become one point.
/// \throw Error(input) naming file and line (binary files: the problem); also if the file is not a surface
Surface_soup read_surface(const std::filesystem::path& path, Read_report* report = nullptr);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_SURFACE_FILE_H
