// SPDX-License-Identifier: LGPL-3.0-or-later
// The front door of the mesh readers: a file in, plain records out, whatever the format.
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

/// What a reader found, and what it left out. Nothing is dropped silently.
struct Read_report {
  std::string format;      ///< such as "Gmsh 4.1" or "OFF"
  std::size_t points = 0;  ///< points of the record
  std::size_t cells = 0;   ///< cells of a cell soup
  std::size_t facets = 0;  ///< polygons of a surface, segments of a planar domain, half-facets of cells
  std::vector<std::string> notes;  ///< one sentence for everything ignored or interpreted
};

/// A surface in space, cells of space, cells of the plane, or a domain of the plane yet to be triangulated.
using Mesh = std::variant<Surface_soup, Cell_soup<3>, Cell_soup<2>, Planar_domain>;

struct Mesh_file {
  Mesh mesh;
  Read_report report;
};

/// "surface", "volume", "planar cells" or "planar domain".
std::string_view kind_name(const Mesh& mesh);

/// Reads any mesh file this build knows. The format follows from the content where that tells, else from the extension;
/// a file compressed with gzip is read as it is. See docs/formats.md for formats and conventions.
///
/// A flat file (every z zero) with polygons and no volumes gives planar cells.
/// \throw Error(input) where the file is unreadable, broken or of an unknown format: file and line where they can be
///        known, what is wrong, what to do
Mesh_file read_mesh(const std::filesystem::path& path);

/// A part of the readers that is optional when the library is built.
struct Build_feature {
  std::string_view name;  ///< "gmsh", "vtk"
  bool present = false;
  std::string version;       ///< empty if absent
  std::string_view purpose;  ///< what it reads
};

/// The optional parts, and which of them this build has.
std::vector<Build_feature> build_features();

/// One line naming every format this build reads.
std::string supported_formats();

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FILE_H
