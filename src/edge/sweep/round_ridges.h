// SPDX-License-Identifier: LGPL-3.0-or-later
// The second test of a complete sweep: whether the chain can be led round ridges.
#ifndef CELLWALK_EDGE_SWEEP_ROUND_RIDGES_H
#define CELLWALK_EDGE_SWEEP_ROUND_RIDGES_H

#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/edge/swept_triangle.h>

namespace cellwalk::detail {

/// As relink_at_ridges(), for an edge of which only its chain is known.
/// \param before the chain before the move
/// \param chain set to that after the move of a free edge
/// \pre !path.blocked
template <int D>
Relink_answer lead_round_ridges(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                                const Chain& before, Relink_scratch<D>& scratch, Chain& chain,
                                Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_ROUND_RIDGES_H
