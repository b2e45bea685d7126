// SPDX-License-Identifier: LGPL-3.0-or-later
// The tests in their order of cost: the old chain, then ridges, then all events.
#include <cellwalk/internal/edge/edge_contact.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>

#include <utility>

#include "confirm_chain.h"
#include "events.h"
#include "round_ridges.h"

namespace cellwalk {
template <int D>
Sweep_result<D> sweep_triangle(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                               const Chain& before, Edge_counts& counts, bool has_certificates) {
  if (path.from.position == path.to.position) {
    // A walk along the edge might find another chain, on the other side of a wall that contains the edge.
    ++counts.edges;
    ++counts.same_chain;
    return {{}, before};
  }
  Chain_result<D> found;
  if (detail::confirm_chain(snapshot, path, q, before, has_certificates, found, counts))
    return {{}, std::move(found.chain)};
  ++counts.changed;
  if (has_certificates && !path.blocked) {
    detail::Relink_scratch<D> scratch;
    Sweep_result<D> result;
    const detail::Relink_answer answer =
        detail::lead_round_ridges(snapshot, path, q, before, scratch, result.chain, counts);
    if (answer == detail::Relink_answer::free) return result;
    if (answer == detail::Relink_answer::blocked && q.dimension == D) {
      result.contact =
          detail::contact_at_ridge<D>(snapshot, {path.from.position, path.to.position, q.position}, scratch);
      return result;
    }
  }
  ++counts.event_sweeps;
  return detail::follow_events(snapshot, path, q, before, counts.walk);
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template Sweep_result<D> sweep_triangle<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&, \
                                             const Chain&, Edge_counts&, bool);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
