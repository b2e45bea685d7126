// SPDX-License-Identifier: LGPL-3.0-or-later
// The common part of searches for any chain of a segment and of tests of chains.
#ifndef CELLWALK_EDGE_CHAIN_ANY_PATH_H
#define CELLWALK_EDGE_CHAIN_ANY_PATH_H

#include <algorithm>

#include "chain_search.h"

namespace cellwalk::detail {

/// The rule of a search that accepts any path.
template <int D>
struct Any_path {
  const Point<D>&p, &q;
  Walk_counts& counts;

  bool is_wrong(const Chain&, const Fraction&) const { return false; }
  Fraction limit_of(const Cell_view<D>&, std::size_t, int) const { return 0; }
  bool is_accepted(const Chain&) const { return true; }
  bool comes_before(const Cell_view<D>& x, const Cell_view<D>& y) const {
    if constexpr (D == 2)
      return false;
    else
      return Rotational_order<Exact>(p, q, counts)(x, y);
  }
};

/// Whether a segment passes the facets of a chain in order. Exact in every position.
template <int D>
bool passes_in_order(const Snapshot<D>& snapshot, const Chain& chain, const Point<D>& p, const Point<D>& q,
                     Walk_counts& counts) {
  if (passes(snapshot, chain, p, q, counts)) return true;
  const Rational_segment<D> segment(p, q);
  Fraction last = 0;
  for (const Half_facet f : chain) {
    const auto met = segment.in_facet(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f));
    if (!met || met->high < last) return false;
    last = std::max<Fraction>(last, met->low);
  }
  return true;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_ANY_PATH_H
