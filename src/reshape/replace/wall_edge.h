// SPDX-License-Identifier: LGPL-3.0-or-later
// An edge that walls have, split at a point exactly on it: walls stay where they are.
#ifndef CELLWALK_RESHAPE_REPLACE_WALL_EDGE_H
#define CELLWALK_RESHAPE_REPLACE_WALL_EDGE_H

#include <cellwalk/environment/snapshot.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace cellwalk::detail {

/// Why an edge cannot be split so; empty if it can.
/// \param cells all cells that have both ends of the edge, simplices in one ring around it
/// \param soup receives the new cells, of which the new point is Snapshot::next_point(), with the marks of
///        the walls at the edge
template <int D>
std::string check_wall_edge(const Snapshot<D>& snapshot, std::span<const Cell> cells,
                            const std::array<std::uint32_t, 2>& edge, const Point<D>& position,
                            Cell_soup<D>& soup);

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_WALL_EDGE_H
