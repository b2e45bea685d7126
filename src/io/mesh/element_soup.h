// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the common part of the readers of Gmsh and VTK files. Volumes and polygons, as elements over
// one list of points, become the appropriate record.
#ifndef CELLWALK_IO_MESH_ELEMENT_SOUP_H
#define CELLWALK_IO_MESH_ELEMENT_SOUP_H

#include <cellwalk/io/mesh_file.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::io {

/// The content of a file of elements: volume cells, polygons that are facets of them or a surface of their
/// own, and lines.
struct Element_soup {
  Cell_soup<3> volumes;  ///< its points are also those of the polygons
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> lines{};  ///< only for bodies
};

/// True if there are points and every z is zero.
bool is_flat(const std::vector<Point<3>>& points);

/// A surface, or 2D cells if it is flat.
Mesh_file surface_or_plane(Surface_soup surface, Read_report report);

/// The volumes, if there are any (polygons are omitted with a note), otherwise the polygons.
/// \throw Error(input) if there are neither
Mesh_file volumes_or_polygons(const std::string& name, Element_soup elements, Read_report report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_SOUP_H
