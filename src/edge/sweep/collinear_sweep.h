// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges whose end moves in their line: the triangle that they sweep is a segment. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H
#define CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/swept_triangle.h>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// sweep_triangle() where a, b and q lie on one line. The edge gets longer and is free; or shorter, and then
/// p must stay on the side of each wall in that line on which the edge lies. Contacts from `until` on do not
/// count.
template <int D>
Sweep_result<D> collinear_sweep(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                                const Chain& before, Walk_counts& counts, std::optional<double> until);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H
