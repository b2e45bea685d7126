// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a point in each hole of a set of polygons.
#ifndef CELLWALK_IO_MESH_HOLE_POINTS_H
#define CELLWALK_IO_MESH_HOLE_POINTS_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <vector>

namespace cellwalk::io {

/// A closed polygon as a loop of point indices, each once.
using Point_ring = std::vector<std::uint32_t>;

/// Points strictly inside the hole `rings[hole]` and outside everything that lies in it: one, or more where
/// another ring touches the hole's and may cut it into several parts. Exact: a point is returned only if it
/// is proven to lie there. Empty if none is found, which takes rings that cross each other.
/// \pre a place is in the domain if an odd number of the rings lies round it
/// Cost: linear in all corners, for each point tried; nearly always the first is good.
std::vector<Point<2>> hole_points(const std::vector<Point<2>>& points, const std::vector<Point_ring>& rings,
                                  std::size_t hole);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_HOLE_POINTS_H
