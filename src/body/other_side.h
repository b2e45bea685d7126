// SPDX-License-Identifier: LGPL-3.0-or-later
// The other side of a facet that is known to be glued.
#ifndef CELLWALK_BODY_OTHER_SIDE_H
#define CELLWALK_BODY_OTHER_SIDE_H

#include <cellwalk/environment/snapshot.h>

#include <bit>

namespace cellwalk::detail {

/// As Snapshot::opposite(), of a facet with a cell on its other side. Where the two cells share one facet,
/// the links of that cell tell without a look at points.
template <int D>
Half_facet other_side(const Snapshot<D>& snapshot, Half_facet f) {
  const Cell own = snapshot.cell_of(f), other = snapshot.neighbour(f);
  Half_facet only = Half_facet::none;
  for (std::size_t b = 0; b < snapshot.block_count(other); ++b) {
    const unsigned there = snapshot.facets_to(own, other, b);
    if (there == 0) continue;
    if (only != Half_facet::none || !std::has_single_bit(there)) return snapshot.opposite(f);
    only = Snapshot<D>::half_facet(other, 4 * b + static_cast<std::size_t>(std::countr_zero(there)));
  }
  return only;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_OTHER_SIDE_H
