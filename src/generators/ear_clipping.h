// SPDX-License-Identifier: LGPL-3.0-or-later
// Triangulation of small 2D polygons by exact ear clipping. Not by CGAL's triangulations, which are GPL.
#ifndef CELLWALK_GENERATORS_EAR_CLIPPING_H
#define CELLWALK_GENERATORS_EAR_CLIPPING_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

using Polygon_indices = std::vector<std::uint32_t>;  ///< points in order around a polygon

/// Cuts a polygon into triangles without adding points; every vertex on its boundary, collinear ones
/// included, is a vertex of a triangle.
/// \pre a simple polygon, counterclockwise, which may touch itself along a bridge
/// Cost: cubic.
std::vector<std::array<std::uint32_t, 3>> clip_ears(std::span<const Point<2>> points,
                                                    Polygon_indices polygon);

/// The polygon between an outer and an inner one, joined by a bridge.
/// \pre both simple and counterclockwise, the inner one strictly inside
Polygon_indices bridge(std::span<const Point<2>> points, const Polygon_indices& outer,
                       const Polygon_indices& inner);

}  // namespace cellwalk::detail

#endif  // CELLWALK_GENERATORS_EAR_CLIPPING_H
