// SPDX-License-Identifier: LGPL-3.0-or-later
// A way through free space from one particle to another, for catheters that find their own path.
#ifndef CELLWALK_SIMULATION_ROUTE_H
#define CELLWALK_SIMULATION_ROUTE_H

#include <cellwalk/walk/walk.h>

#include <vector>

namespace cellwalk {

/// A polyline from one particle to another whose pieces are all free: the shortest way through the centres of cells
/// joined by passable facets, pulled straight wherever an exact walk says that the short cut is free.
/// Returns both ends as well; empty if no way through passable facets joins the two cells.
/// Cost: that of a shortest-path search, about 1 us a cell.
template <int D>
std::vector<Point<D>> find_route(const Snapshot<D>& snapshot, const Particle<D>& from, const Particle<D>& to,
                                 Walk_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_ROUTE_H
