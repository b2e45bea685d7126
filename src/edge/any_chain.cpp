// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "moving_walk.h"
#include "rational_segment.h"

namespace cellwalk {

template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts) {
  Chain_result<D> result = find_chain(snapshot, p, q, counts);
  if (!result.contact) return result;
  // An edge that stands still is one that moves by nothing.
  const Swept_triangle<D> triangle{p.position, p.position, q.position};
  const detail::Moment<D> now;
  const detail::Moving_line<D> line(triangle, now, counts);
  const auto accept = [](const Chain&) { return true; };
  detail::Moving_walk<D, decltype(accept)> ways(snapshot, line, q, accept);
  if (!ways.from(p.cell)) return result;
  result.contact.reset();
  result.chain = ways.chain();
  return result;
}

template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts) {
  Cell cell = p.cell;
  for (const Half_facet f : chain) {
    if (snapshot.cell_of(f) != cell || snapshot.is_impassable(f)) return false;
    cell = snapshot.neighbor(f);
  }
  if (cell != q.cell) return false;
  if (passes(snapshot, chain, p.position, q.position, counts)) return true;
  const detail::Rational_segment<D> segment(p.position, q.position);
  Fraction last = 0;
  for (const Half_facet f : chain) {
    const auto met = segment.in_facet(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f));
    if (!met || met->high < last) return false;
    last = std::max<Fraction>(last, met->low);
  }
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                          \
  template Chain_result<D> find_any_chain<D>(const Snapshot<D>&, const Particle<D>&, const Particle<D>&, \
                                             Walk_counts&);                                              \
  template bool is_chain<D>(const Snapshot<D>&, const Particle<D>&, const Particle<D>&, const Chain&,    \
                            Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
