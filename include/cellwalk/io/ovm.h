// SPDX-License-Identifier: LGPL-3.0-or-later
// OpenVolumeMesh ASCII (.ovm), the native format of environments: polyhedral cells, with walls and solid
// cells.
//
// 3D: the property `FProp bool "impassable"` marks walls, `CProp bool "solid"` solid cells. 2D: a file
// without polyhedra whose z are all zero. Faces are the cells, edges their facets: `EProp bool "impassable"`,
// `FProp bool "solid"`. The mesh property `MProp int "dimension"` gives the dimension explicitly. Boolean
// properties `group NAME` of facets and of cells are groups of that name.
#ifndef CELLWALK_IO_OVM_H
#define CELLWALK_IO_OVM_H

#include <cellwalk/io/mesh_file.h>
#include <cellwalk/records/cell_soup.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads an .ovm file. Coordinates are exact; the order of points, cells and facets is that of the file.
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

#endif  // CELLWALK_IO_OVM_H
