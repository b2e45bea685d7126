// SPDX-License-Identifier: LGPL-3.0-or-later
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
  if (!is_same) result = {chain, {}, {}};
  return true;
}

template bool detail::is_confirmed<2>(const Snapshot<2>&, const Chain&, std::span<const Half_facet>,
                                      const Particle<2>&, const Particle<2>&, Chain_result<2>&, Edge_counts&);
template bool detail::is_confirmed<3>(const Snapshot<3>&, const Chain&, std::span<const Half_facet>,
                                      const Particle<3>&, const Particle<3>&, Chain_result<3>&, Edge_counts&);

}  // namespace cellwalk
