// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of an edge from event to event, exactly. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_SWEEP_EVENTS_H
#define CELLWALK_EDGE_SWEEP_EVENTS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <optional>

namespace cellwalk::detail {

/// How the chain just after an event is found. The result is the same.
enum class Event_rule : bool {
  turns,  ///< round the ridge that the edge meets, if that is all that happens then, otherwise by a walk
  walks   ///< always by a walk along the edge; for tests
};

/// Updates the chain from event to event until p arrives, is blocked, or `until`; contacts from then on do
/// not count. Every position is allowed; p may also move in the line of its edge.
/// \pre q.dimension is that of the lowest feature in which q lies, or less
/// Cost: some 13,000 instructions to a contact in general position.
template <int D>
Sweep_result<D> follow_events(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                              const Chain& before, Walk_counts& counts, std::optional<double> until = {},
                              Event_rule rule = Event_rule::turns);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_EVENTS_H
