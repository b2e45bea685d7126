// SPDX-License-Identifier: LGPL-3.0-or-later
// The common case of equal chains: they differ only around one ridge that the edge passes. Theory:
// docs/sweep.md, events.
#ifndef CELLWALK_EDGE_CHAIN_DIFFER_AROUND_RIDGE_H
#define CELLWALK_EDGE_CHAIN_DIFFER_AROUND_RIDGE_H

#include <cellwalk/edge/chain.h>

#include "edge/exact/moving_line.h"

namespace cellwalk::detail {

/// True proves that two chains of the edge at line.time() are equal: the facets in which they differ lie
/// around one ridge, the edge meets the line of that ridge and lies in none of their planes, so it meets all
/// of them in one point. False is inconclusive.
/// \pre the edge passes both at that time, and they start and end in the same cells
/// Cost: a sign for each of these facets, and one more.
template <int D>
bool differ_only_around_one_ridge(const Snapshot<D>& snapshot, const Moving_line<D>& line, const Chain& chain,
                                  const Chain& other);

extern template bool differ_only_around_one_ridge<2>(const Snapshot<2>&, const Moving_line<2>&, const Chain&,
                                                     const Chain&);
extern template bool differ_only_around_one_ridge<3>(const Snapshot<3>&, const Moving_line<3>&, const Chain&,
                                                     const Chain&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_DIFFER_AROUND_RIDGE_H
