// SPDX-License-Identifier: LGPL-3.0-or-later
// All chains of a segment: one for each way past the walls in its line. Theory: docs/sweep.md, sides.
#ifndef CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H
#define CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H

#include <cellwalk/edge/chain.h>

#include <vector>

namespace cellwalk::detail {

/// The chains of pq, no two of them equal, in the order in which a walk from p prefers their sides.
/// Cost: that of a walk for each combination of sides; of more than 256 the first ones.
template <int D>
std::vector<Chain> all_chains(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                              Walk_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H
