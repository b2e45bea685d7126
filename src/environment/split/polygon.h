// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangulations of polygons, in 2D and of facets in 3D. Internal to splitting.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_POLYGON_H
#define CELLWALK_ENVIRONMENT_SPLIT_POLYGON_H

#include <cellwalk/kernel/exact.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

using Triangle = std::array<std::uint32_t, 3>;
using Triangulation = std::vector<Triangle>;

/// +1 or -1 if a closed 2D polygon is simple (sides meet in common ends only) and runs counterclockwise or
/// clockwise; otherwise 0.
/// Cost: quadratic, linear if it is convex.
int simple_turn(Predicate_counts& counts, std::span<const Point<2>> polygon);

/// Triangulations of a simple polygon without flat triangles, as positions in the direction of the polygon,
/// all different: fans from each vertex that allows one, then those found by cutting ears. `rank` orders the
/// vertices; the lowest come first. At least one is found; the search ends at `most`.
/// \pre sign is simple_turn(polygon), not 0
std::vector<Triangulation> triangulations(Predicate_counts& counts, std::span<const Point<2>> polygon,
                                          int sign, std::span<const std::uint32_t> rank, std::size_t most);

/// A loop that starts at its lowest vertex, in the direction of the lower one of its neighbours: the same for
/// both sides.
std::vector<std::uint32_t> canonical_loop(std::span<const std::uint32_t> loop);

/// Triangulations of a facet into triangles of point indices in the direction of `loop`, the preferred one
/// first. Planar facets must be simple polygons. Other facets are cut along diagonals that are valid in their
/// projection along the main axis of their normal, or, if there are none, into any fan without flat
/// triangles. The search ends at `most`. Empty if there is none: the facet is planar and crosses or touches
/// itself.
std::vector<Triangulation> facet_triangulations(Predicate_counts& counts, std::span<const Point<3>> points,
                                                std::span<const std::uint32_t> loop, std::size_t most);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SPLIT_POLYGON_H
