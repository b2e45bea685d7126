// SPDX-License-Identifier: LGPL-3.0-or-later
// A route through free space from one particle to another, for catheters.
#ifndef CELLWALK_INTERNAL_SIMULATION_ROUTE_H
#define CELLWALK_INTERNAL_SIMULATION_ROUTE_H

#include <cellwalk/walk/walk.h>

#include <vector>

namespace cellwalk {

/// A polyline from one particle to another whose pieces are all free: the shortest path through the centres
/// of cells joined by passable facets, shortened wherever an exact walk proves the shortcut free. The result
/// includes both ends; it is empty if passable facets do not connect the two cells.
/// Cost: that of a shortest-path search, about 1 us a cell.
template <int D>
std::vector<Point<D>> find_route(const Snapshot<D>& snapshot, const Particle<D>& from, const Particle<D>& to,
                                 Walk_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_ROUTE_H
