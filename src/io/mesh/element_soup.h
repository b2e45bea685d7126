// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: what the readers of Gmsh and VTK have in common. Volumes and polygons as elements over one
// list of points become the record that fits.
#ifndef CELLWALK_IO_MESH_ELEMENT_SOUP_H
#define CELLWALK_IO_MESH_ELEMENT_SOUP_H

#include <cellwalk/io/mesh_file.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::io {

/// What a file of elements holds: volume cells, polygons that are facets of them or a surface of their own,
/// and lines.
struct Element_soup {
  Cell_soup<3> volumes;  ///< its points are those of the polygons, too
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> lines{};  ///< only where a body is read
};

/// True if there are points and every z is zero.
bool is_flat(const std::vector<Point<3>>& points);

/// A surface, or the cells of the plane if it is flat.
Mesh_file surface_or_plane(Surface_soup surface, Read_report report);

/// Volumes if there are any (polygons are left out and that is noted), else the polygons.
/// \throw Error(input) where there are neither
Mesh_file volumes_or_polygons(const std::string& name, Element_soup elements, Read_report report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_SOUP_H
