// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a point in each hole of a set of polygons. Not by CGAL's triangulations, which are GPL.
#ifndef CELLWALK_IO_MESH_HOLE_POINTS_H
#define CELLWALK_IO_MESH_HOLE_POINTS_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <vector>

namespace cellwalk::io {

/// A closed polygon as a loop of different point indices.
using Point_ring = std::vector<std::uint32_t>;

/// Points strictly inside the hole `rings[hole]` and outside everything in it: one, or more if another ring
/// touches that of the hole and may divide it into several parts. Exact: a point is returned only if it is
/// proved to lie there. Empty if none is found, which only happens if rings cross each other.
/// \pre a point is in the domain if an odd number of rings enclose it
/// Cost: linear in the number of all corners for each point tried; nearly always the first one succeeds.
std::vector<Point<2>> hole_points(const std::vector<Point<2>>& points, const std::vector<Point_ring>& rings,
                                  std::size_t hole);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_HOLE_POINTS_H
