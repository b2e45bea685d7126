// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of an edge whose end moves in its line: the triangle is a segment. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H
#define CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// sweep_triangle() for collinear a, b and q. If the edge gets longer, it is free; if it gets shorter, p must
/// stay on the side of each wall in that line on which the edge lies. Contacts from `until` on do not count.
template <int D>
Sweep_result<D> collinear_sweep(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                                const Chain& before, Walk_counts& counts, std::optional<double> until);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_COLLINEAR_SWEEP_H
