// SPDX-License-Identifier: LGPL-3.0-or-later
// The search of the star of a ridge or vertex that a line passes exactly. Rule: docs/walk.md, step 4.
#ifndef CELLWALK_WALK_DETAIL_STAR_H
#define CELLWALK_WALK_DETAIL_STAR_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/predicates.h>
#include <cellwalk/walk/detail/signs.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>

namespace cellwalk::detail {

/// Unit normal of a half-facet towards its cell, rounded.
template <int D>
Vector<D> inner_normal(const Cell_view<D>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  if constexpr (D == 2)
    return unit_normal(cell.point(loop[0]), cell.point(loop[1]));
  else
    return unit_normal(cell.point(loop[0]), cell.point(loop[2]), cell.point(loop[1]));
}

/// True if facet i of a cell contains point u, and v too (3D ridge).
template <int D>
bool facet_contains(const Cell_view<D>& cell, std::size_t i, std::uint32_t u, std::uint32_t v) {
  bool has_u = false, has_v = false;
  for (const std::uint16_t w : cell.loop(i)) {
    has_u |= cell.point_index(w) == u;
    has_v |= cell.point_index(w) == v;
  }
  return has_u && has_v;
}

/// Facets on a way through a star.
using Star_way = boost::container::small_vector<Half_facet, 8>;

struct Star_result {
  Cell cell = Cell::none;              ///< where the motion goes on; none: blocked
  Half_facet wall = Half_facet::none;  ///< if blocked: the wall that blocks it
  Star_way way;                        ///< the way there
};

/// A cell of a star, and how the search came to it.
struct Star_cell {
  Cell cell;
  std::size_t parent;
  Half_facet facet;  ///< of the parent
};

/// Searches the star of ridge uv (or vertex u = v), breadth first from `start` through passable facets, for cells in which
/// the motion from a towards b continues: all their facets at the ridge or vertex have b on their inner side or on them.
/// Each is handed to accept(cell, way), way being the facets on the way there, until that returns true. Returns a wall that
/// is in the way, if there is one.
template <class Kernel, int D, class Accept>
Half_facet explore_star(const Snapshot<D>& snapshot, Cell start, std::uint32_t u, std::uint32_t v,
                        const Point<D>& a, const Point<D>& b, Walk_counts& counts, Accept accept) {
  ++counts.star_searches;
  boost::container::small_vector<Star_cell, 32> queue{{start, 0, Half_facet::none}};
  Half_facet wall = Half_facet::none;
  double steepest = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Cell c = queue[head].cell;
    const Cell_view<D> cell = snapshot.view(c);
    ++counts.star_cells;
    bool accepted = true;
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (!facet_contains(cell, i, u, v)) continue;
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const bool outside = side<Kernel>(cell, i, b, counts) > 0;
      accepted &= !outside;
      if (!snapshot.is_impassable(f)) {
        const Cell next = snapshot.neighbor(f);
        const auto is_next = [next](const Star_cell& known) { return known.cell == next; };
        if (std::none_of(queue.begin(), queue.end(), is_next)) queue.push_back({next, head, f});
      } else if (outside) {
        // Of all walls in the way the one met most head-on is reported; the choice decides nothing.
        const double slope = dot(inner_normal(cell, i), a - b);
        if (wall == Half_facet::none || slope > steepest) {
          wall = f;
          steepest = slope;
        }
      }
    }
    if (!accepted) continue;
    Star_way way;
    for (std::size_t i = head; i != 0; i = queue[i].parent) way.push_back(queue[i].facet);
    std::reverse(way.begin(), way.end());
    if (accept(c, way)) break;
  }
  return wall;
}

/// The first cell of a star in which the motion continues.
template <class Kernel, int D>
Star_result search_star(const Snapshot<D>& snapshot, Cell start, std::uint32_t u, std::uint32_t v,
                        const Point<D>& a, const Point<D>& b, Walk_counts& counts) {
  Star_result result;
  result.wall =
      explore_star<Kernel>(snapshot, start, u, v, a, b, counts, [&](Cell cell, const Star_way& way) {
        result.cell = cell;
        result.way = way;
        return true;
      });
  return result;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_DETAIL_STAR_H
