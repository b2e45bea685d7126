// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells and walls that a swept triangle meets. Theory: docs/sweep.md, flood.
#ifndef CELLWALK_INTERNAL_EDGE_MAY_INTERSECT_H
#define CELLWALK_INTERNAL_EDGE_MAY_INTERSECT_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>

namespace cellwalk::detail {

/// False proves that closed facet i of a cell misses the closed triangle. True if they meet, if they may meet
/// in one plane or line, and, if the triangle is a segment other than from a = q to b, if the facet meets the
/// line or the box of the segment.
bool may_intersect(const Cell_view<2>& cell, std::size_t i, const Swept_triangle<2>& t, Walk_counts& counts);
bool may_intersect(const Cell_view<3>& cell, std::size_t i, const Swept_triangle<3>& t, Walk_counts& counts);

/// False proves that vertex k of facet i (2D), or its edge from vertex k to the next (3D), misses the closed
/// triangle. True if they meet, and if they may meet in one plane or line.
bool may_meet_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k, const Swept_triangle<2>& t,
                    Walk_counts& counts);
bool may_meet_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k, const Swept_triangle<3>& t,
                    Walk_counts& counts);

/// The same as may_intersect(), by boxes and the plane of the facet only: cheaper, and true more often.
template <int D>
bool may_overlap(const Cell_view<D>& cell, std::size_t i, const Swept_triangle<D>& t, Walk_counts& counts);

/// Cells of a flood.
using Flooded = boost::container::small_vector<Cell, 64>;

/// Finds the cells that the triangle meets, from `start` through passable facets, and calls on_wall(facet)
/// for each of their walls that it may meet. Returns false if on_wall() does, or if there are more than
/// `most_cells` cells.
template <int D, class On_wall>
bool flood(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle, Edge_counts& counts,
           std::size_t most_cells, Flooded& found, On_wall on_wall) {
  ++counts.floods;
  found.assign(1, start);
  for (std::size_t head = 0; head < found.size(); ++head) {
    const Cell c = found[head];
    ++counts.flooded_cells;
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const bool is_wall = snapshot.is_impassable(f);
      const Cell next = snapshot.neighbour(f);
      if (!is_wall && std::find(found.begin(), found.end(), next) != found.end()) continue;
      if (!may_intersect(cell, i, triangle, counts.walk)) continue;
      if (is_wall) {
        if (!on_wall(f)) return false;
      } else {
        if (found.size() == most_cells) return false;
        found.push_back(next);
      }
    }
  }
  return true;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_MAY_INTERSECT_H
