// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells linked at a point. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_LINK_H
#define CELLWALK_EDGE_LINK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/walk/detail/signs.h>
#include <cellwalk/walk/detail/star.h>

#include <algorithm>

namespace cellwalk::detail {

/// True if x, a point of the closed cell, lies in its facet i.
template <int D>
bool lies_in(const Cell_view<D>& cell, std::size_t i, const Point<D>& x, Walk_counts& counts) {
  return side<Exact>(cell, i, x, counts) == 0 && in_facet(cell, i, x);
}

/// Appends the passable facets, all of which hold x, on the way from one cell that holds x to another. If there is no way,
/// the two are not linked at x: returns a wall at x that the search met, the same however cells are numbered. Else
/// Half_facet::none.
template <int D>
Half_facet append_link(const Snapshot<D>& snapshot, Chain& chain, Cell from, Cell to, const Point<D>& x,
                       Walk_counts& counts) {
  struct Found {
    Cell cell;
    std::size_t parent;
    Half_facet facet;  ///< of the parent
  };
  boost::container::small_vector<Found, 16> queue{{from, 0, Half_facet::none}};
  Half_facet wall = Half_facet::none;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Cell c = queue[head].cell;
    if (c == to) {
      const std::size_t end = chain.size();
      for (std::size_t i = head; i != 0; i = queue[i].parent) chain.push_back(queue[i].facet);
      std::reverse(chain.begin() + static_cast<std::ptrdiff_t>(end), chain.end());
      return Half_facet::none;
    }
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (!lies_in(cell, i, x, counts)) continue;
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot.is_impassable(f)) {
        if (wall == Half_facet::none ||
            is_placed_before(cell, i, snapshot.view(snapshot.cell_of(wall)), snapshot.facet_of(wall)))
          wall = f;
        continue;
      }
      const Cell next = snapshot.neighbor(f);
      const auto is_next = [next](const Found& known) { return known.cell == next; };
      if (std::none_of(queue.begin(), queue.end(), is_next)) queue.push_back({next, head, f});
    }
  }
  return wall;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_LINK_H
