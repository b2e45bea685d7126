// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/three_segments.h>

#include "confirm.h"

namespace cellwalk {

template <int D>
bool detail::is_confirmed(const Snapshot<D>& snapshot, const Chain& before,
                          std::span<const Half_facet> crossed, const Particle<D>& p, const Particle<D>& q,
                          Chain_result<D>& result, Edge_counts& counts) {
  ++counts.edges;
  Chain chain = before;
  walk_start(snapshot, chain, crossed);
  if (chain.empty()) {
    ++counts.same_cell;
    result = {};
    return true;
  }
  counts.chain_facets += chain.size();
  // A walk is faster than the signs of passes(), but where several chains are legal it may find another one.
  result = find_chain(snapshot, p, q, counts.walk);
  const bool is_same = !result.contact && result.chain == chain;
  if (!is_same && !passes(snapshot, chain, p.position, q.position, counts.walk)) return false;
  ++counts.same_chain;
  if (!is_same) result = {chain, {}};
  return true;
}

template <int D>
Chain_result<D> check_third_segment(const Snapshot<D>& snapshot, const Chain& before,
                                    std::span<const Half_facet> crossed, const Particle<D>& p,
                                    const Particle<D>& q, Edge_counts& counts) {
  Chain_result<D> result;
  if (!detail::is_confirmed(snapshot, before, crossed, p, q, result, counts)) ++counts.changed;
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                        \
  template bool detail::is_confirmed<D>(const Snapshot<D>&, const Chain&, std::span<const Half_facet>, \
                                        const Particle<D>&, const Particle<D>&, Chain_result<D>&,      \
                                        Edge_counts&);                                                 \
  template Chain_result<D> check_third_segment<D>(const Snapshot<D>&, const Chain&,                    \
                                                  std::span<const Half_facet>, const Particle<D>&,     \
                                                  const Particle<D>&, Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
