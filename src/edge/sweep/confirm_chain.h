// SPDX-License-Identifier: LGPL-3.0-or-later
// What every sweep begins with: does the old chain still hold?
#ifndef CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H
#define CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/swept_triangle.h>

namespace cellwalk::detail {

/// True proves that the triangle swept by the edge pq while p goes its way is free, with its chain in
/// `result`: the ends share a cell, or lie in two cells whose union is convex, or the edge passes the chain
/// it had before, led on by what p crossed. Else `result` is that of a walk along the edge, its contact left
/// to locate_contact(). Where the triangle lies in the plane of walls that begin inside of it, so that the
/// edge may have a choice of sides, nothing is proved.
/// \pre !way.blocked
template <int D>
bool confirm_chain(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                   const Chain& before, const Edge_certificates& certificates, Chain_result<D>& result,
                   Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_SWEEP_CONFIRM_CHAIN_H
