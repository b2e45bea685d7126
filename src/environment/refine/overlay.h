// SPDX-License-Identifier: LGPL-3.0-or-later
// A convex polygon divided by others that overlap it. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_OVERLAY_H
#define CELLWALK_ENVIRONMENT_REFINE_OVERLAY_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// Turns in a plane.
struct Signs_in_plane {
  double tolerance = 0;  ///< 0: exact. Otherwise points within this distance of a line lie on it

  int turn(const Point<2>& a, const Point<2>& b, const Point<2>& c) const;
};

/// Vertices by their places among some points.
using Overlay_loop = std::vector<std::uint32_t>;

/// Divides a convex polygon into its common parts with others, each whole, and convex pieces of the
/// remainder, between points that are there already.
/// \param points of all polygons, in a plane
/// \param rim the polygon to be divided, counterclockwise
/// \param others counterclockwise, convex, and without common interior points. Where sides meet, all that
///        meet there have the point as a vertex
/// \param tolerance 0: exact. Otherwise points within this distance of a line lie on it
/// \return counterclockwise loops; empty if the polygons are not as they should be
/// Cost: that of sorting; quadratic in the number of vertices around the remainder.
std::vector<Overlay_loop> overlay(std::span<const Point<2>> points, const Overlay_loop& rim,
                                  std::span<const Overlay_loop> others, double tolerance);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_OVERLAY_H
