// SPDX-License-Identifier: LGPL-3.0-or-later
// All chains of a segment: one for each way past the walls in its line. Theory: docs/sweep.md, sides.
#ifndef CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H
#define CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H

#include <cellwalk/edge/chain.h>

#include <vector>

namespace cellwalk::detail {

struct All_chains {
  std::vector<Chain> chains;
  bool are_all = true;  ///< no others were left out
};

/// The chains of pq, no two of them equal, in the order in which a walk from p prefers their sides.
/// Cost: that of a walk for each combination of sides. Of more than 256 combinations the first ones are
/// tried, and those of the second side of all walls, of the third, and so on, whose chains come second.
template <int D>
All_chains all_chains(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                      Walk_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_ALL_CHAINS_H
