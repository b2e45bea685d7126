// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces from bytes in memory.
#ifndef CELLWALK_INTERNAL_IO_PARSE_SURFACE_H
#define CELLWALK_INTERNAL_IO_PARSE_SURFACE_H

#include <cellwalk/io/mesh_file.h>

#include <string>
#include <string_view>

namespace cellwalk::io {

enum class Surface_format { off, obj, stl, ply };

/// Reads from bytes in memory.
/// \param name stands for the file in errors
Surface_soup parse_surface(const std::string& name, std::string_view bytes, Surface_format format,
                           Read_report* report = nullptr);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_PARSE_SURFACE_H
