// SPDX-License-Identifier: LGPL-3.0-or-later
// The chain of an edge, by a walk that also notes planes.
#ifndef CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H
#define CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H

#include <cellwalk/edge/chain.h>

namespace cellwalk::detail {

/// The same as cellwalk::find_chain(), with the contact left to locate_contact(), unless the segment arrives
/// at q on the wrong side; then its time is 1. Sets `on_planes` if q lies on the plane of a facet of a cell
/// that the walk visited.
template <int D>
Chain_result<D> chain_of_walk(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                              Walk_counts& counts, bool& on_planes);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CHAIN_OF_WALK_H
