// SPDX-License-Identifier: LGPL-3.0-or-later
#include "confirm.h"

namespace cellwalk {
template <int D>
bool detail::is_confirmed(const Snapshot<D>& snapshot, const Chain& before,
                          std::span<const Half_facet> crossed, const Particle<D>& p, const Particle<D>& q,
                          const Edge_certificates& certificates, Chain_result<D>& result,
                          Edge_counts& counts) {
  ++counts.edges;
  Chain chain = before;
  walk_start(snapshot, chain, crossed);
  if (certificates.same_cell && chain.empty()) {
    ++counts.same_cell;
    result = {};
    return true;
  }
  if (certificates.convex_pair && chain.size() == 1 &&
      snapshot.convex_passage(snapshot.cell_of(chain.front()), snapshot.neighbor(chain.front())) !=
          Half_facet::none) {
    ++counts.convex_pair;
    result = {chain, {}, {}};
    return true;
  }
  counts.chain_facets += chain.size();
  // A walk is faster than the signs of passes(), but where several chains are legal it may find another one.
  result = find_chain(snapshot, p, q, counts.walk);
  if (!certificates.same_chain) return false;
  const bool is_same = !result.contact && result.chain == chain;
  if (!is_same && !passes(snapshot, chain, p.position, q.position, counts.walk)) return false;
  ++counts.same_chain;
  if (!is_same) result = {chain, {}, {}};
  return true;
}

template bool detail::is_confirmed<2>(const Snapshot<2>&, const Chain&, std::span<const Half_facet>,
                                      const Particle<2>&, const Particle<2>&, const Edge_certificates&,
                                      Chain_result<2>&, Edge_counts&);
template bool detail::is_confirmed<3>(const Snapshot<3>&, const Chain&, std::span<const Half_facet>,
                                      const Particle<3>&, const Particle<3>&, const Edge_certificates&,
                                      Chain_result<3>&, Edge_counts&);

}  // namespace cellwalk
