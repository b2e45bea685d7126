// SPDX-License-Identifier: LGPL-3.0-or-later
// The signs of the old chain at the new position, and the walls that may leave a choice of sides.
#include "confirm_chain.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>

#include "edge/chain/chain_of_walk.h"

namespace cellwalk {
namespace {

/// False proves that an edge that passes a chain throughout its sweep has no choice of sides: no wall of the
/// cells of the chain lies in the plane of the triangle.
bool may_have_choice(const Snapshot<3>& snapshot, const Swept_triangle<3>& t, Cell start, const Chain& chain,
                     Walk_counts& counts) {
  const auto has_wall = [&](Cell c) {
    const Cell_view<3> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i)
      if (snapshot.is_impassable(Snapshot<3>::half_facet(c, i)) &&
          detail::side<Exact>(cell, i, t.q, counts) == 0 && detail::side<Exact>(cell, i, t.b, counts) == 0 &&
          detail::side<Exact>(cell, i, t.a, counts) == 0)
        return true;
    return false;
  };
  if (has_wall(start)) return true;
  return std::ranges::any_of(chain, [&](Half_facet f) { return has_wall(snapshot.neighbour(f)); });
}

/// In 2D, walls lie in the line of an edge only while its end moves in that line; then the end has the
/// choice.
bool may_have_choice(const Snapshot<2>&, const Swept_triangle<2>&, Cell, const Chain&, Walk_counts&) {
  return false;
}

}  // namespace

template <int D>
bool detail::confirm_chain(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                           const Chain& before, bool has_certificates, Chain_result<D>& result,
                           Edge_counts& counts) {
  ++counts.edges;
  const Particle<D>& p = path.to;
  const Cell end = path.blocked ? path.visited.back() : p.cell;
  Chain chain = before;
  prepend_crossed_facets(snapshot, chain, path.crossed);
  const auto has_no_choice = [&] {
    const Swept_triangle<D> triangle{path.from.position, p.position, q.position};
    return !may_have_choice(snapshot, triangle, end, chain, counts.walk);
  };
  // A triangle with a corner in the interior of a cell lies in the plane of no facet of it.
  const bool has_inner_corner = (!path.blocked && p.dimension == D) || q.dimension == D;
  if (has_certificates && chain.empty() && (has_inner_corner || has_no_choice())) {
    ++counts.same_cell;
    result = {};
    return true;
  }
  counts.chain_facets += chain.size();
  if (path.blocked) {
    // If the edge passes the chain at the target, beyond the wall, then also where p stops: V is convex.
    if (!has_certificates || !passes(snapshot, chain, p.position, q.position, counts.walk) ||
        !has_no_choice())
      return false;
    ++counts.same_chain;
    result = {};
    result.chain = chain;
    return true;
  }
  // A walk is faster than the signs of passes(), but may find another chain if several are valid.
  bool on_planes = false;
  result = chain_of_walk(snapshot, p, q, counts.walk, on_planes);
  if (!has_certificates) return false;
  const bool is_same = !result.contact && result.chain == chain;
  if (!is_same && !passes(snapshot, chain, p.position, q.position, counts.walk)) return false;
  if (!(is_same && !on_planes) && !has_no_choice()) return false;
  ++counts.same_chain;
  result = {};
  result.chain = chain;
  return true;
}

template bool detail::confirm_chain<2>(const Snapshot<2>&, const Vertex_path<2>&, const Particle<2>&,
                                       const Chain&, bool, Chain_result<2>&, Edge_counts&);
template bool detail::confirm_chain<3>(const Snapshot<3>&, const Vertex_path<3>&, const Particle<3>&,
                                       const Chain&, bool, Chain_result<3>&, Edge_counts&);

}  // namespace cellwalk
