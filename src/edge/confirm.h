// SPDX-License-Identifier: LGPL-3.0-or-later
// What every sweep begins with: does the old chain still hold?
#ifndef CELLWALK_EDGE_CONFIRM_H
#define CELLWALK_EDGE_CONFIRM_H

#include <cellwalk/edge/chain.h>

namespace cellwalk::detail {

/// True proves that the triangle swept by the edge pq is free, with its chain in `result`: the ends share a cell, or lie in two
/// cells whose union is convex, or the edge passes the chain it had before, led on by what p crossed. Else `result` is that of
/// a walk along the edge.
template <int D>
bool is_confirmed(const Snapshot<D>& snapshot, const Chain& before, std::span<const Half_facet> crossed,
                  const Particle<D>& p, const Particle<D>& q, const Edge_certificates& certificates,
                  Chain_result<D>& result, Edge_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CONFIRM_H
