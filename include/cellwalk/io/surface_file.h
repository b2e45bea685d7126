// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces: polygon soups from OFF, OBJ, STL and PLY.
#ifndef CELLWALK_IO_SURFACE_FILE_H
#define CELLWALK_IO_SURFACE_FILE_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/surface_soup.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

enum class Surface_format { off, obj, stl, ply };

/// Reads a surface. The polygons are unchanged; meshing checks whether they are closed, oriented and
/// manifold. The format is determined by the extension, which may be followed by `.gz`. STL corners of equal
/// coordinates become one point.
/// \throw Error(input) naming file and line (binary files: the problem); also if the file is not a surface
Surface_soup read_surface(const std::filesystem::path& path, Read_report* report = nullptr);

/// Reads from bytes in memory.
/// \param name stands for the file in errors
Surface_soup parse_surface(const std::string& name, std::string_view bytes, Surface_format format,
                           Read_report* report = nullptr);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_SURFACE_FILE_H
