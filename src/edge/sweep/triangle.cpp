// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/flood.h>
#include <cellwalk/internal/edge/triangle.h>

#include <utility>

#include "confirm_chain.h"
#include "events.h"

namespace cellwalk {
template <int D>
Sweep_result<D> sweep_triangle(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                               const Chain& before, Edge_counts& counts,
                               const Edge_certificates& certificates) {
  if (path.from.position == path.to.position) {
    // A walk along the edge might find another chain, on the other side of a wall that contains the edge.
    ++counts.edges;
    ++counts.same_chain;
    return {{}, before};
  }
  Chain_result<D> found;
  if (detail::confirm_chain(snapshot, path, q, before, certificates, found, counts))
    return {{}, std::move(found.chain)};
  ++counts.changed;
  const Swept_triangle<D> triangle{path.from.position, path.to.position, q.position};
  // The wall that blocks p meets the triangle.
  if (certificates.flood && !path.blocked && !found.contact &&
      is_free_of_walls(snapshot, path.from.cell, triangle, counts))
    return {{}, std::move(found.chain)};
  ++counts.event_sweeps;
  return detail::follow_events(snapshot, path, q, before, counts.walk);
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template Sweep_result<D> sweep_triangle<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&, \
                                             const Chain&, Edge_counts&, const Edge_certificates&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
