// SPDX-License-Identifier: LGPL-3.0-or-later
// Simplices of a snapshot, and of a soup that is to replace some of them.
#ifndef CELLWALK_RESHAPE_CUT_SIMPLICES_H
#define CELLWALK_RESHAPE_CUT_SIMPLICES_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>
#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace cellwalk::detail {

/// The sign of the volume of a simplex.
inline int volume_sign(const std::array<Point<2>, 3>& x) {
  Predicate_counts counts;
  return Exact::orientation(counts, x[0], x[1], x[2]);
}
inline int volume_sign(const std::array<Point<3>, 4>& x) {
  Predicate_counts counts;
  return Exact::orientation(counts, x[0], x[1], x[2], x[3]);
}

/// Corners of the facets of a positive simplex, by the corner that each lacks, counterclockwise from outside.
inline constexpr std::array<std::array<std::size_t, 2>, 3> sides_of_triangle{{{1, 2}, {2, 0}, {0, 1}}};
inline constexpr std::array<std::array<std::size_t, 3>, 4> sides_of_tetrahedron{
    {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}}};

/// \param walls by the corner that a facet lacks
inline void add_cell(Cell_soup<2>& soup, const std::array<std::uint32_t, 3>& x,
                     const std::array<bool, 3>& walls, bool is_solid) {
  for (std::size_t k = 0; k < 3; ++k)
    soup.add_facet({x[sides_of_triangle[k][0]], x[sides_of_triangle[k][1]]}, walls[k]);
  soup.end_cell(is_solid);
}
inline void add_cell(Cell_soup<3>& soup, const std::array<std::uint32_t, 4>& x,
                     const std::array<bool, 4>& walls, bool is_solid) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& side = sides_of_tetrahedron[k];
    soup.add_facet({x[side[0]], x[side[1]], x[side[2]]}, walls[k]);
  }
  soup.end_cell(is_solid);
}

template <int D>
bool has_corner(const Snapshot<D>& snapshot, Cell cell, std::uint32_t point) {
  return std::ranges::find(snapshot.view(cell).vertices, point) != snapshot.view(cell).vertices.end();
}

/// The facet of a simplex that lacks a corner.
template <int D>
Half_facet facet_off(const Snapshot<D>& snapshot, Cell cell, std::uint32_t corner) {
  const Cell_view<D> view = snapshot.view(cell);
  std::size_t f = 0;
  while (has_point(view, f, corner)) ++f;
  return Snapshot<D>::half_facet(cell, f);
}

/// The unit normal of a facet, into its cell.
template <int D>
Vector<D> inward_normal(const Snapshot<D>& snapshot, Half_facet facet) {
  const auto loop = snapshot.loop(facet);
  if constexpr (D == 2)
    return unit_normal(snapshot.point(loop[0]), snapshot.point(loop[1]));
  else
    return -1.0 * unit_normal(snapshot.point(loop[0]), snapshot.point(loop[1]), snapshot.point(loop[2]));
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_SIMPLICES_H
