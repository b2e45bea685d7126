// SPDX-License-Identifier: LGPL-3.0-or-later
// Planar domains: Triangle's .poly, and WKT polygons with holes.
#ifndef CELLWALK_INTERNAL_IO_PLANAR_FILE_H
#define CELLWALK_INTERNAL_IO_PLANAR_FILE_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/surface_soup.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads Triangle's .poly: points, segments and holes. The points may be in a .node file beside it.
/// \throw Error(input) with file and line
Planar_domain read_poly(const std::filesystem::path& path, Read_report* report = nullptr);

/// Reads from text in memory. If the text has no points, they are read from the file `name` with the
/// extension .node.
Planar_domain parse_poly(const std::string& name, std::string_view text, Read_report* report = nullptr);

/// Reads WKT: one or more POLYGON and MULTIPOLYGON, with or without z (which is ignored). Rings that share
/// points share their indices. Each inner ring is a hole, with a point strictly inside it and outside every
/// polygon in it.
/// \throw Error(input) with file and line: not WKT, a ring that is not closed or has fewer than three
///        corners, a hole in which no point can be found
Planar_domain parse_wkt(const std::string& name, std::string_view text, Read_report* report = nullptr);
Planar_domain read_wkt(const std::filesystem::path& path, Read_report* report = nullptr);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_PLANAR_FILE_H
