// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's check of a body edge: its ends move one after the other, then a temporary particle walks along it.
// Paper: section III. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_THREE_SEGMENTS_H
#define CELLWALK_EDGE_THREE_SEGMENTS_H

#include <cellwalk/edge/triangle.h>

namespace cellwalk {

/// Checks the edge pq after p has gone its way; q stood still. `before` is the chain of the edge as it was.
///
/// Where the edge passes its old chain still, the whole triangle that it swept is proved free. Elsewhere a temporary
/// particle is walked from p to q, and only that segment is checked: obstacles inside the triangle that cross neither it nor
/// the way of p are missed.
/// \pre `before` is the chain of the edge before the move; !way.blocked
/// Cost: a few ns if p and q share a cell or the chain is empty; some ten signs a facet of the chain; else a walk.
template <int D>
Chain_result<D> check_third_segment(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                                    const Chain& before, Edge_counts& counts,
                                    const Edge_certificates& certificates = {});

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_THREE_SEGMENTS_H
