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
/// possible, otherwise by the extension. The file may be compressed with gzip. A folder is read as a case or
/// a mesh of OpenFOAM. See docs/formats.md for formats and conventions.
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

/// Reads a surface. The polygons are unchanged; meshing checks whether they are closed, oriented and
/// manifold. The format is determined by the extension, which may be followed by `.gz`. STL corners of equal
/// coordinates become one point.
/// \throw Error(input) naming file and line (binary files: the problem); also if the file is not a surface
Surface_soup read_surface(const std::filesystem::path& path, Read_report* report = nullptr);

/// Reads OpenVolumeMesh ASCII (.ovm), the native format of environments: polyhedral cells, with walls and
/// solid cells. Coordinates are exact; the order of points, cells and facets is that of the file.
///
/// 3D: the property `FProp bool "impassable"` marks walls, `CProp bool "solid"` solid cells. 2D: a file
/// without polyhedra whose z are all zero. Faces are the cells, edges their facets: `EProp bool
/// "impassable"`, `FProp bool "solid"`. The mesh property `MProp int "dimension"` gives the dimension
/// explicitly. Boolean properties `group NAME` of facets and of cells are groups of that name.
/// \throw Error(input) with file and line: not OVM ASCII, cut short, an index out of range, halfedges that
///        form no loop; a group without a name, or of anything else than facets and cells
/// Cost: about 2 s for a million tetrahedra.
Mesh_file read_ovm(const std::filesystem::path& path);

/// Reads from text in memory.
/// \param name stands for the file in errors
Mesh_file parse_ovm(const std::string& name, std::string_view text);

/// Writes a soup so that reading it gives the same points bit for bit, the same cells in the same order with
/// the same facets in the same order, walls and solid cells included. The second side of a facet may start
/// its loop elsewhere. The file appears complete or not at all.
/// \param groups are read again with both sides of each facet
/// \throw Error(input) if a loop has a vertex out of range, if a group has a facet or cell out of range or a
///        name that is empty or has a quote or a control character; Error(other) if the file cannot be
///        written
template <int D>
void write_ovm(const std::filesystem::path& path, const Cell_soup<D>& soup, const Soup_groups& groups = {});

extern template void write_ovm<2>(const std::filesystem::path&, const Cell_soup<2>&, const Soup_groups&);
extern template void write_ovm<3>(const std::filesystem::path&, const Cell_soup<3>&, const Soup_groups&);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FILE_H
