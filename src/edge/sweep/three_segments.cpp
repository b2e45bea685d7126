// SPDX-License-Identifier: LGPL-3.0-or-later
// The third segment, from the end of p to q, as a chain with or without a contact.
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/three_segments.h>

#include "confirm_chain.h"

namespace cellwalk {

template <int D>
Chain_result<D> check_third_segment(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                    const Particle<D>& q, const Chain& before, Edge_counts& counts,
                                    bool has_certificates) {
  Chain_result<D> result;
  if (!detail::confirm_chain(snapshot, path, q, before, has_certificates, result, counts)) ++counts.changed;
  if (result.contact) locate_contact(snapshot, path.to.position, q.position, *result.contact);
  return result;
}

template Chain_result<2> check_third_segment<2>(const Snapshot<2>&, const Vertex_path<2>&, const Particle<2>&,
                                                const Chain&, Edge_counts&, bool);
template Chain_result<3> check_third_segment<3>(const Snapshot<3>&, const Vertex_path<3>&, const Particle<3>&,
                                                const Chain&, Edge_counts&, bool);

}  // namespace cellwalk
