// SPDX-License-Identifier: LGPL-3.0-or-later
// The numbering of the vertices and facets of a cell by which cells of one combinatorial type share one
// shape.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_CANONICAL_SHAPE_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_CANONICAL_SHAPE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// A cell of a soup with its facets and vertices renumbered. It is reused from cell to cell, so that nothing
/// is allocated after the first cells.
struct Canonical_cell {
  Cell_shape shape;
  std::vector<std::uint32_t> vertices;  ///< point index of each local vertex
  std::vector<std::uint32_t> facets;    ///< half-facet of the soup for each facet of the shape
};

/// Renumbers cell c by a breadth-first traversal of its facets from the first vertex of its first facet, then
/// rotates each loop until its first three vertices (3D) are not collinear. Facets that the traversal does
/// not reach (then the cell is not closed, and certification refuses it) follow in input order.
/// \throw Error(input) if the cell has too many vertices
template <int D>
void canonicalize(const Cell_soup<D>& soup, std::span<const Point<D>> points, std::size_t c,
                  Canonical_cell& out);

/// \throw Error(input) if canonicalize() would
template <int D>
void check_size(const Cell_soup<D>& soup, std::size_t c);

/// Rotates a loop until its first three vertices are not collinear, if it has three such consecutive
/// vertices. `vertices` are the points of the cell's local vertices.
void turn_off_line(std::span<const Point<3>> points, std::span<const std::uint32_t> vertices,
                   std::span<std::uint16_t> loop);

extern template void canonicalize<2>(const Cell_soup<2>&, std::span<const Point<2>>, std::size_t,
                                     Canonical_cell&);
extern template void canonicalize<3>(const Cell_soup<3>&, std::span<const Point<3>>, std::size_t,
                                     Canonical_cell&);

extern template void check_size(const Cell_soup<2>&, std::size_t);
extern template void check_size(const Cell_soup<3>&, std::size_t);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_CANONICAL_SHAPE_H
