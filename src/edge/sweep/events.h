// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of an edge from event to event, exactly. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_SWEEP_EVENTS_H
#define CELLWALK_EDGE_SWEEP_EVENTS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/swept_triangle.h>

#include <optional>

namespace cellwalk::detail {

/// Updates the chain from event to event until p arrives, is blocked, or `until`; contacts from then on do
/// not count. Every position is allowed; p may also move in the line of its edge.
template <int D>
Sweep_result<D> follow_events(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                              const Chain& before, Walk_counts& counts, std::optional<double> until = {});

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_EVENTS_H
