// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells and walls that a swept triangle meets. Theory: docs/sweep.md, flood.
#ifndef CELLWALK_INTERNAL_EDGE_MAY_INTERSECT_H
#define CELLWALK_INTERNAL_EDGE_MAY_INTERSECT_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/swept_triangle.h>
#include <cellwalk/internal/edge/certain_triangle.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/// The facets that a triangle meets, of one cell after the other.
template <int D>
class Met_facets {
 public:
  Met_facets(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Walk_counts& counts)
      : snapshot_(snapshot), triangle_(snapshot.frame(), triangle), exact_(triangle), counts_(counts) {}

  /// As may_intersect(): lanes decide first.
  bool may_intersect(const Cell_view<D>& cell, std::size_t facet, Half_facet f) {
    const Certain_meeting meeting =
        triangle_.is_certain() ? this->meeting(cell, facet, f) : Certain_meeting::open;
    if (meeting != Certain_meeting::open) return meeting == Certain_meeting::met;
    return detail::may_intersect(cell, facet, exact_, counts_);
  }

 private:
  Certain_meeting meeting(const Cell_view<D>& cell, std::size_t facet, Half_facet f) {
    const std::uint32_t lane = to_index(f) % 4;
    if (block_ != to_index(f) / 4) {
      block_ = to_index(f) / 4;
      planes_ = triangle_.sides(*snapshot_.blocks(Cell{block_}));
    }
    if ((planes_.missed() >> lane & 1) != 0) return Certain_meeting::missed;
    if constexpr (D == 2) return Certain_meeting::open;
    corners_.clear();
    append_corners<D>(snapshot_.frame(), cell, facet, corners_);
    return triangle_.meeting(corners_, planes_, lane);
  }

  const Snapshot<D>& snapshot_;
  Certain_triangle<D> triangle_;
  const Swept_triangle<D>& exact_;
  Walk_counts& counts_;
  std::uint32_t block_ = to_index(Cell::none);
  typename Certain_triangle<D>::Plane_sides planes_{};
  std::vector<Facet_corners<D>> corners_;
};

/// Finds the cells that the triangle meets, from `start` through passable facets, and calls on_wall(facet)
/// for each of their walls that it may meet. Returns false if on_wall() does, or if there are more than
/// `most_cells` cells.
template <int D, class On_wall>
bool flood(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle, Edge_counts& counts,
           std::size_t most_cells, Flooded& found, On_wall on_wall) {
  ++counts.floods;
  found.assign(1, start);
  Met_facets<D> met(snapshot, triangle, counts.walk);
  for (std::size_t head = 0; head < found.size(); ++head) {
    const Cell c = found[head];
    ++counts.flooded_cells;
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const bool is_wall = snapshot.is_impassable(f);
      const Cell next = snapshot.neighbour(f);
      if (!is_wall && std::find(found.begin(), found.end(), next) != found.end()) continue;
      if (!met.may_intersect(cell, i, f)) continue;
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
