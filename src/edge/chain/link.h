// SPDX-License-Identifier: LGPL-3.0-or-later
// The path between cells that are linked at a point. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_CHAIN_LINK_H
#define CELLWALK_EDGE_CHAIN_LINK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>

namespace cellwalk::detail {

/// True if x, a point of the closed cell, lies in its facet i.
template <int D>
bool lies_in(const Cell_view<D>& cell, std::size_t i, const Point<D>& x, Walk_counts& counts) {
  return side<Exact>(cell, i, x, counts) == 0 && in_facet(cell, i, x);
}

/// Appends the passable facets, all of which contain x, on the path from one cell that contains x to another.
/// If there is no path, the two are not linked at x: returns a wall at x that the search met, which does not
/// depend on the numbering of cells. Otherwise returns Half_facet::none.
template <int D>
Half_facet append_link(const Snapshot<D>& snapshot, Chain& chain, Cell from, Cell to, const Point<D>& x,
                       Walk_counts& counts) {
  Half_facet wall = Half_facet::none;
  const auto holds = [&](const Cell_view<D>& cell, std::size_t i) { return lies_in(cell, i, x, counts); };
  const auto note = [&](const Cell_view<D>&, std::size_t, Half_facet f) {
    wall = first_placed(snapshot, wall, f);
  };
  Link_search<D> links(snapshot, from);
  while (links.next()) {
    if (links.cell() == to) {
      links.append_path(links.place(), chain);
      return Half_facet::none;
    }
    links.expand_all(holds, note);
  }
  if (wall == Half_facet::none && !snapshot.is_cell(to)) refuse_removed_cell();
  return wall;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_LINK_H
