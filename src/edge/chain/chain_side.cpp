// SPDX-License-Identifier: LGPL-3.0-or-later
// The intersections of an edge with facets, and the cells linked with its chain at a parameter.
#include "chain_side.h"

#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// The cell in which the chain passes the point at t.
Cell cell_at(const Exact_edge& edge, Cell start, const Chain& chain, const Fraction& t) {
  Cell cell = start;
  for (const Half_facet f : chain) {
    const std::optional<Span> met = edge.in_facet(f);
    if (met && t < met->low) break;
    cell = edge.snapshot().neighbour(f);
  }
  return cell;
}

}  // namespace

std::optional<Span> Exact_edge::in_facet(Half_facet f) const {
  return in_facet(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f));
}

std::optional<Span> Exact_edge::in_facet(const Cell_view<3>& cell, std::size_t i) const {
  if (is_apart(cell, i)) return {};
  Walk_counts counts;
  if (side<Exact>(cell, i, from_, counts) * side<Exact>(cell, i, to_, counts) > 0) return {};
  return segment_.in_facet(cell, i);
}

bool Exact_edge::is_apart(const Cell_view<3>& cell, std::size_t i) const {
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax(from_[k], to_[k]);
    const auto is_below = [&, end = low](std::uint16_t v) { return cell.point(v)[k] < end; };
    const auto is_above = [&, end = high](std::uint16_t v) { return cell.point(v)[k] > end; };
    if (std::all_of(loop.begin(), loop.end(), is_below) || std::all_of(loop.begin(), loop.end(), is_above))
      return true;
  }
  return false;
}

std::vector<Cell> linked_cells(const Exact_edge& edge, Cell start, const Chain& chain, const Fraction& t) {
  return linked_cells(edge.snapshot(), cell_at(edge, start, chain, t),
                      [&](const Cell_view<3>& cell, std::size_t i) {
                        const std::optional<Span> met = edge.in_facet(cell, i);
                        return met && met->low <= t && t <= met->high;
                      });
}

}  // namespace cellwalk::detail
