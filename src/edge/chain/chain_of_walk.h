// SPDX-License-Identifier: LGPL-3.0-or-later
// The chain of an edge, and what its walk tells besides.
#ifndef CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H
#define CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H

#include <cellwalk/edge/chain.h>

namespace cellwalk::detail {

/// As cellwalk::find_chain(), with a contact left to locate_contact(), unless the segment arrives at q on
/// another side: its time is 1 then. Also whether q lies on the plane of a facet of a cell that the segment
/// was walked through.
template <int D>
Chain_result<D> chain_of_walk(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                              Walk_counts& counts, bool& on_planes);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H
