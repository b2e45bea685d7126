// SPDX-License-Identifier: LGPL-3.0-or-later
// A soup of cells: the content of a mesh file, before anything is glued or checked.
#ifndef CELLWALK_RECORDS_CELL_SOUP_H
#define CELLWALK_RECORDS_CELL_SOUP_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// Cells as lists of facets, facets as loops of point indices, all in flat arrays (compressed rows).
///
/// 3D: a facet is a polygon, its loop counterclockwise seen from outside the cell.
/// 2D: a cell is a polygon; its facets are its edges, two vertices each, in counterclockwise order around the
/// cell.
///
/// A facet shared by two cells occurs once in each of them (two half-facets). It is impassable if either of
/// them is.
template <int D>
struct Cell_soup {
  std::vector<Point<D>> points;
  std::vector<std::uint32_t> cell_begin{0};   ///< facets of cell c: [cell_begin[c], cell_begin[c+1])
  std::vector<std::uint32_t> facet_begin{0};  ///< vertices of facet f: [facet_begin[f], facet_begin[f+1])
  std::vector<std::uint32_t> vertices;        ///< point indices
  std::vector<std::uint8_t> impassable;       ///< per half-facet: 1 = wall
  std::vector<std::uint8_t> solid;  ///< per cell: 1 = not free space (kept in the complex, walled off)

  std::size_t cell_count() const { return cell_begin.size() - 1; }
  std::size_t facet_count() const { return facet_begin.size() - 1; }  ///< half-facets

  std::span<const std::uint32_t> facet(std::size_t f) const {
    return {vertices.data() + facet_begin[f], vertices.data() + facet_begin[f + 1]};
  }

  /// Appends a facet to the cell under construction.
  void add_facet(std::span<const std::uint32_t> loop, bool wall = false) {
    vertices.insert(vertices.end(), loop.begin(), loop.end());
    facet_begin.push_back(static_cast<std::uint32_t>(vertices.size()));
    impassable.push_back(wall);
  }
  void add_facet(std::initializer_list<std::uint32_t> loop, bool wall = false) {
    add_facet(std::span<const std::uint32_t>(loop.begin(), loop.size()), wall);
  }
  /// Closes the cell whose facets were appended since the last call; returns its index.
  std::size_t end_cell(bool is_solid = false) {
    cell_begin.push_back(static_cast<std::uint32_t>(facet_count()));
    solid.push_back(is_solid);
    return cell_count() - 1;
  }
};

/// Appends a tetrahedron; (b-a, c-a, d-a) must be right-handed for it to be positively oriented.
/// \param soup receives four facets and a cell
/// \param a,b,c,d indices of points of the soup
inline std::size_t add_tetrahedron(Cell_soup<3>& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                   std::uint32_t d) {
  soup.add_facet({a, c, b});
  soup.add_facet({a, b, d});
  soup.add_facet({b, c, d});
  soup.add_facet({c, a, d});
  return soup.end_cell();
}

/// Appends a hexahedron in the VTK order: v[0..3] counterclockwise seen from above (inside), v[4..7] above
/// them.
inline std::size_t add_hexahedron(Cell_soup<3>& soup, const std::array<std::uint32_t, 8>& v) {
  soup.add_facet({v[0], v[3], v[2], v[1]});
  soup.add_facet({v[4], v[5], v[6], v[7]});
  soup.add_facet({v[0], v[1], v[5], v[4]});
  soup.add_facet({v[1], v[2], v[6], v[5]});
  soup.add_facet({v[2], v[3], v[7], v[6]});
  soup.add_facet({v[3], v[0], v[4], v[7]});
  return soup.end_cell();
}

/// Appends a prism (wedge): triangle v[0..2] counterclockwise seen from inside (above), v[3..5] above it.
inline std::size_t add_prism(Cell_soup<3>& soup, const std::array<std::uint32_t, 6>& v) {
  soup.add_facet({v[0], v[2], v[1]});
  soup.add_facet({v[3], v[4], v[5]});
  soup.add_facet({v[0], v[1], v[4], v[3]});
  soup.add_facet({v[1], v[2], v[5], v[4]});
  soup.add_facet({v[2], v[0], v[3], v[5]});
  return soup.end_cell();
}

/// Appends a pyramid: base v[0..3] counterclockwise seen from inside (the apex), apex v[4].
inline std::size_t add_pyramid(Cell_soup<3>& soup, const std::array<std::uint32_t, 5>& v) {
  soup.add_facet({v[0], v[3], v[2], v[1]});
  soup.add_facet({v[0], v[1], v[4]});
  soup.add_facet({v[1], v[2], v[4]});
  soup.add_facet({v[2], v[3], v[4]});
  soup.add_facet({v[3], v[0], v[4]});
  return soup.end_cell();
}

/// Appends a 2D polygon, with its vertices in counterclockwise order.
inline std::size_t add_polygon(Cell_soup<2>& soup, std::span<const std::uint32_t> v) {
  for (std::size_t i = 0; i < v.size(); ++i) soup.add_facet({v[i], v[(i + 1) % v.size()]});
  return soup.end_cell();
}

/// A named group of facets and cells, as files have them.
struct Soup_group {
  std::vector<std::uint32_t> facets;  ///< numbers of half-facets; one side of a facet suffices
  std::vector<std::uint32_t> cells;

  bool operator==(const Soup_group&) const = default;
};

using Soup_groups = std::map<std::string, Soup_group>;

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_CELL_SOUP_H
