// SPDX-License-Identifier: LGPL-3.0-or-later
// Are two chains of one segment equal: linked at each of its points? Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_EQUAL_CHAINS_H
#define CELLWALK_EDGE_EQUAL_CHAINS_H

#include <cellwalk/edge/chain.h>

#include "rational_segment.h"

namespace cellwalk::detail {

/// Compares two chains that start in the cell `start`, both passed by the segment. If they are not equal, `wall` is set to a
/// wall that parts them.
template <int D>
bool are_equal(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
               const Chain& chain, const Chain& other, Half_facet& wall);

extern template bool are_equal<2>(const Snapshot<2>&, const Rational_segment<2>&, Cell, const Chain&,
                                  const Chain&, Half_facet&);
extern template bool are_equal<3>(const Snapshot<3>&, const Rational_segment<3>&, Cell, const Chain&,
                                  const Chain&, Half_facet&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EQUAL_CHAINS_H
