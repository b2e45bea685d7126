// SPDX-License-Identifier: GPL-3.0-or-later
// How far walls lie from the triangles of the file.
#ifndef CELLWALK_MESHING_REPAIR_WALL_DISTANCE_H
#define CELLWALK_MESHING_REPAIR_WALL_DISTANCE_H

#include <span>
#include <vector>

#include "facets.h"

namespace cellwalk::detail {

struct Wall_distance {
  double most = 0;  ///< in units of the surface
  Point<3> place{};
};

/// The largest distance of the corners and some inner points of walls from a surface; caps and mouths aside.
/// Cost: 10 us a wall.
Wall_distance distance_of_walls(const std::vector<Point<3>>& points, std::span<const Facet> walls,
                                const Facets& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_WALL_DISTANCE_H
