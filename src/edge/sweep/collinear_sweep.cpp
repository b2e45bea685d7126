// SPDX-License-Identifier: LGPL-3.0-or-later
// The chain extended by the path of p where the edge gets longer, and the pieces compared otherwise.
#include "collinear_sweep.h"

#include <cellwalk/internal/edge/swept_triangle.h>

#include <algorithm>

#include "edge/chain/equal_chains.h"
#include "edge/contact/edge_contact.h"
#include "edge/exact/exit_time.h"

namespace cellwalk {

template <int D>
Sweep_result<D> detail::collinear_sweep(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                        const Particle<D>& q, const Chain& before, Walk_counts& counts,
                                        std::optional<double> until) {
  const Point<D>&a = path.from.position, &b = path.to.position;
  Sweep_result<D> result{{}, before};
  int axis = 0;
  while (axis + 1 < D && a[axis] == b[axis]) ++axis;
  const bool shrinks =
      (a[axis] < b[axis] && a[axis] < q.position[axis]) || (a[axis] > b[axis] && a[axis] > q.position[axis]);
  if (!shrinks) {
    // The edge gets longer: it keeps its chain, behind the path of p.
    prepend_crossed_facets(snapshot, result.chain, path.crossed);
    return result;
  }
  // Parameters on the segment from a to b or to q, whichever is further: that of q, and that of the end of p.
  const Ring path_of_p = CGAL::abs(Ring(Ring(b[axis]) - Ring(a[axis])));
  const Ring distance_to_q = CGAL::abs(Ring(Ring(q.position[axis]) - Ring(a[axis])));
  const Ring whole = std::max<Ring>(path_of_p, distance_to_q);
  const Rational_segment<D> line(a, path_of_p < distance_to_q ? q.position : b);
  const Fraction at_q(distance_to_q, whole);
  Event_time<D> limit(until.value_or(1));
  if (path.blocked) {
    const auto blocked = exit_time<D>(snapshot.view(path.visited.back()), a, b, counts);
    if (blocked < limit) limit = blocked;
  }
  const Fraction end = Fraction(path_of_p, whole) * limit.value();

  const auto pieces = pieces_of<D>(snapshot, line, path.from.cell, {before.data(), before.size()}, at_q);
  const auto walked = pieces_of<D>(snapshot, line, path.from.cell, path.crossed, end);
  if (const auto parting = parting_of(snapshot, line, pieces, walked)) {
    result.chain.clear();
    const Exact_time time = to_time(parting->at * Fraction(whole, path_of_p));
    result.contact = edge_contact<D>(snapshot, time, parting->wall, line.at(parting->at));
    return result;
  }
  std::size_t i = 0;
  if (end <= at_q) {
    // The rest of the chain, linked with p.
    while (pieces[i].high < end) ++i;
    result.chain.assign(before.begin() + static_cast<std::ptrdiff_t>(i), before.end());
    prepend_crossed_facets<D>(snapshot, result.chain,
                              link_at(snapshot, line, pieces[i].cell, path.to.cell, end));
  } else {
    // p has passed q: the rest of its path.
    while (walked[i].high < at_q) ++i;
    const auto link = link_at(snapshot, line, walked[i].cell, q.cell, at_q);
    result.chain.assign(link.begin(), link.end());
    prepend_crossed_facets(snapshot, result.chain, path.crossed.subspan(i));
  }
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                       \
  template Sweep_result<D> detail::collinear_sweep<D>(const Snapshot<D>&, const Vertex_path<D>&,      \
                                                      const Particle<D>&, const Chain&, Walk_counts&, \
                                                      std::optional<double>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
