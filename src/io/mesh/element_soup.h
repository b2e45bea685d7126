// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the common part of the readers of files of elements. Volumes and polygons, as elements over
// one list of points, become the appropriate record.
#ifndef CELLWALK_IO_MESH_ELEMENT_SOUP_H
#define CELLWALK_IO_MESH_ELEMENT_SOUP_H

#include <cellwalk/io/mesh_file.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cellwalk::io {

/// The members of a named group, as positions in the lists of a soup of elements.
struct Element_group {
  std::vector<std::uint32_t> volumes, polygons, lines, points;
};

/// The content of a file of elements: volume cells, polygons that are facets of them or a surface of their
/// own, and lines.
struct Element_soup {
  Cell_soup<3> volumes;  ///< its points are also those of the polygons
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> lines{};  ///< for bodies, and for groups in 2D
  std::map<std::string, Element_group> groups{};
};

/// True if there are points and every z is zero.
bool is_flat(const std::vector<Point<3>>& points);

/// A surface, or 2D cells if it is flat.
Mesh_file surface_or_plane(Surface_soup surface, Read_report report);

/// The volumes, if there are any, otherwise the polygons. Groups of them, and of elements of one dimension
/// less that are facets of them, are kept; other elements are omitted with a note.
/// \throw Error(input) if there are neither
Mesh_file volumes_or_polygons(const std::string& name, Element_soup elements, Read_report report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_SOUP_H
