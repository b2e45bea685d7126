// SPDX-License-Identifier: LGPL-3.0-or-later
// The corners of the facets of a chain, read from the snapshot for the relinking.
#include "round_ridges.h"

#include <cellwalk/internal/edge/swept_triangle.h>

#include <vector>

namespace cellwalk::detail {

template <int D>
Relink_answer lead_round_ridges(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                                const Chain& before, Relink_scratch<D>& scratch, Chain& chain,
                                Edge_counts& counts) {
  const Particle<D>& p = path.to;
  Float_point<D> mapped;
  if (!snapshot.frame().map(p.position, mapped)) return Relink_answer::open;
  Certain_line<D> to(snapshot.frame(), p.position, mapped);
  to.lead_to(q.position, false);
  std::vector<Facet_corners<D>> corners, corners_after;
  for (const Half_facet f : before) append_corners(snapshot, f, corners);
  const Moving_edge<D> edge{path.from.position,
                            q.position,
                            to,
                            false,
                            p.dimension == D || q.dimension == D,
                            path.crossed,
                            false,
                            Half_facet::none,
                            {before.data(), before.size()},
                            corners};
  const Relink_answer answer = relink_at_ridges<D>(snapshot, edge, scratch, chain, corners_after);
  counts.relinked += answer == Relink_answer::free;
  return answer;
}

template Relink_answer lead_round_ridges<2>(const Snapshot<2>&, const Vertex_path<2>&, const Particle<2>&,
                                            const Chain&, Relink_scratch<2>&, Chain&, Edge_counts&);
template Relink_answer lead_round_ridges<3>(const Snapshot<3>&, const Vertex_path<3>&, const Particle<3>&,
                                            const Chain&, Relink_scratch<3>&, Chain&, Edge_counts&);

}  // namespace cellwalk::detail
