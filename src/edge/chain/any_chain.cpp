// SPDX-License-Identifier: LGPL-3.0-or-later
// A chain of a segment on any sides of walls, and the test whether given facets are one.
#include <cellwalk/edge/chain.h>

#include "any_path.h"

namespace cellwalk {
template <int D>
Chain_result<D> find_any_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                               Walk_counts& counts) {
  Chain_result<D> result = find_chain(snapshot, p, q, counts);
  if (!result.contact || p.position == q.position) return result;
  const detail::Rational_segment<D> segment(p.position, q.position);
  detail::Any_path<D> rule{p.position, q.position, counts};
  detail::Chain_search<D, detail::Any_path<D>> search(snapshot, segment, q, rule, counts);
  if (!search.find(p.cell)) return result;
  result.chain = search.chain();
  result.contact.reset();
  return result;
}

template <int D>
bool is_chain(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, const Chain& chain,
              Walk_counts& counts) {
  Cell cell = p.cell;
  for (const Half_facet f : chain) {
    if (snapshot.cell_of(f) != cell || snapshot.is_impassable(f)) return false;
    cell = snapshot.neighbour(f);
  }
  return cell == q.cell && detail::passes_in_order(snapshot, chain, p.position, q.position, counts);
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
