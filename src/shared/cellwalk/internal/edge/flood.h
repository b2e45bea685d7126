// SPDX-License-Identifier: LGPL-3.0-or-later
// The flood of a swept triangle: if it meets no wall at all, the sweep is free. Theory: docs/sweep.md. Paper:
// section III.
#ifndef CELLWALK_INTERNAL_EDGE_FLOOD_H
#define CELLWALK_INTERNAL_EDGE_FLOOD_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/swept_triangle.h>

#include <cstddef>

namespace cellwalk {

/// True proves that no wall meets the closed triangle. Then the sweep is free, and all chains of bq are equal
/// to its result. False is inconclusive: a wall may only touch the triangle or lie in its plane, the triangle
/// may be degenerate, or more than `most_cells` cells meet it. All signs are exact.
/// \pre a lies in the closure of `start`, a free cell
/// Cost: some twenty signs a facet of the cells that meet the triangle.
template <int D>
bool is_free_of_walls(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle,
                      Edge_counts& counts, std::size_t most_cells = 64);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_FLOOD_H
