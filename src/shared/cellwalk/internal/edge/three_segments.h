// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's check of a body edge: its ends move one after the other, then a temporary particle walks along
// it.
// Paper: section III. Theory: docs/sweep.md.
#ifndef CELLWALK_INTERNAL_EDGE_THREE_SEGMENTS_H
#define CELLWALK_INTERNAL_EDGE_THREE_SEGMENTS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>

namespace cellwalk {

/// Checks the edge pq after p has moved along its path while q stood still. If the edge still crosses its old
/// chain, the whole swept triangle is proved free. Otherwise a temporary particle walks from p to q, and only
/// that segment is checked: obstacles inside the triangle that cross neither it nor the path of p are missed.
/// Paper: section III.
/// \param path the path of p
/// \param before the chain of the edge before the move
/// \pre !path.blocked
/// Cost: a few ns if p and q share a cell or the chain is empty; some ten signs a facet of the chain;
/// otherwise a walk.
template <int D>
Chain_result<D> check_third_segment(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                    const Particle<D>& q, const Chain& before, Edge_counts& counts,
                                    bool has_certificates = true);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_THREE_SEGMENTS_H
