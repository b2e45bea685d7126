// SPDX-License-Identifier: LGPL-3.0-or-later
// The first test of every sweep: whether the old chain is still valid.
#ifndef CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H
#define CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>

namespace cellwalk::detail {

/// True proves that the triangle swept by the edge pq while p moves along its path is free, with its chain in
/// `result`: the ends share a cell, or the edge passes its old chain, extended by the facets that p crossed.
/// Otherwise `result` is that of a walk along the edge, with the contact left to locate_contact(). If the
/// triangle lies in the plane of walls that begin inside it, so that the edge may have a choice of sides,
/// nothing is proved. If p is blocked, the triangle is that of the motion until then, and there is no walk.
template <int D>
bool confirm_chain(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                   const Chain& before, bool has_certificates, Chain_result<D>& result, Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H
