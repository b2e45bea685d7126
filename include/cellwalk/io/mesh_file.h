// SPDX-License-Identifier: LGPL-3.0-or-later
// The common interface of the mesh readers: plain data from a file of any format.
#ifndef CELLWALK_IO_MESH_FILE_H
#define CELLWALK_IO_MESH_FILE_H

#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cellwalk::io {

/// The report of a reader, with everything that it omitted. Nothing is dropped silently.
struct Read_report {
  std::string format;      ///< such as "Gmsh 4.1" or "OFF"
  std::size_t points = 0;  ///< points of the mesh
  std::size_t cells = 0;   ///< cells of a cell soup
  std::size_t facets = 0;  ///< polygons of a surface, segments of a planar domain, half-facets of cells
  std::vector<std::string> notes;  ///< one sentence for everything ignored or interpreted
  std::size_t collapsed = 0;       ///< cells and polygons with repeated corners, read without these
};

/// A surface, 3D cells, 2D cells, or a planar domain to be triangulated.
using Mesh = std::variant<Surface_soup, Cell_soup<3>, Cell_soup<2>, Planar_domain>;

struct Mesh_file {
  Mesh mesh;
  Read_report report;
  Soup_groups groups{};  ///< of cells; both sides of each facet
};

/// "surface", "volume", "planar cells" or "planar domain".
std::string_view kind_name(const Mesh& mesh);

/// Reads a mesh file of any format that this build supports. The format is determined by the content if
/// possible, otherwise by the extension. The file may be compressed with gzip. See docs/formats.md for
/// formats and conventions.
///
/// A flat file (every z zero) with polygons and no volumes gives 2D cells.
/// \throw Error(input) if the file is unreadable, broken or of an unknown format; with file and line if
///        known, the problem and the remedy
Mesh_file read_mesh(const std::filesystem::path& path);

/// The same of the bytes of such a file, for sources that can be read only once.
/// \param name stands for the file in errors, and determines the format if the content does not
Mesh_file read_mesh(const std::filesystem::path& name, std::string bytes);

/// One line with all formats that this build reads.
std::string supported_formats();

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FILE_H
