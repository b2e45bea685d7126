// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of triangles that points lie on: T-junctions.
#ifndef CELLWALK_MESHING_REPAIR_SIDES_H
#define CELLWALK_MESHING_REPAIR_SIDES_H

#include <cstdint>
#include <utility>
#include <vector>

#include "changes.h"
#include "facets.h"

namespace cellwalk::detail {

/// A side of triangles: its ends, ascending.
using Side = std::pair<std::uint32_t, std::uint32_t>;

/// Splits sides at points that lie on them, in all triangles with these sides. A side with several such
/// points is split at the one nearest to its middle: call it again until it finds none. Triangles with a
/// corner on their own opposite side are left out.
/// \param sides   that may be split
/// \param points  that may lie on them
/// \param within  a point is on a side if it is that near to it, and farther than that from the ends
/// \param component of each point; only points of its own component lie on a side. Empty: all do
/// \return the points on sides; measured is the largest distance
/// Cost: 1 us a side.
Found split_sides(Facets& surface, const std::vector<Side>& sides, const std::vector<std::uint32_t>& points,
                  double within, const std::vector<std::uint32_t>& component = {});

/// Splits sides at which triangles do not cancel in pairs at other ends of such sides, in components that
/// are connected by points: sides of different ones may lie along each other by chance.
/// \param seam    the distance of points from sides of the border
/// \param within  that from other sides
/// \return the points on sides; measured is the largest distance in parts of the size
Found split_uneven_sides(Facets& surface, double seam, double within);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_SIDES_H
