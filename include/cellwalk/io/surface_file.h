// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces: OFF, OBJ, STL and PLY into a polygon soup.
#ifndef CELLWALK_IO_SURFACE_FILE_H
#define CELLWALK_IO_SURFACE_FILE_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/surface_soup.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

enum class Surface_format { off, obj, stl, ply };

/// Reads a surface; the polygons are taken as they stand (open, inside out, not manifold: meshing judges that).
/// The format follows from the extension, `.gz` after it allowed. STL corners of equal coordinates become one point.
/// \throw Error(input) naming file and line (binary files: what is wrong with them); also where the file is no surface
Surface_soup read_surface(const std::filesystem::path& path, Read_report* report = nullptr);

/// The same from bytes in memory; `name` stands for the file in errors.
Surface_soup parse_surface(const std::string& name, std::string_view bytes, Surface_format format,
                           Read_report* report = nullptr);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_SURFACE_FILE_H
