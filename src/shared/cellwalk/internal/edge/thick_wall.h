// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move among points and edges with a radius. Theory: docs/radius.md, walls that move.
#ifndef CELLWALK_INTERNAL_EDGE_THICK_WALL_H
#define CELLWALK_INTERNAL_EDGE_THICK_WALL_H

#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/kernel/exact_time.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace cellwalk::detail {

/// Where a wall comes within the radius of a point or an edge, and would come nearer.
template <int D>
struct Thick_meeting {
  Exact_time time;
  Feature of_wall;                   ///< of its corners: 0 is the one that moves
  Feature of_feature;                ///< of the points given
  Point<D> on_wall{}, on_feature{};  ///< the nearest points then, rounded
  Vector<D> normal{};                ///< from the wall to the feature, of length 1
};

/// The order of meetings: by time, then by the feature that is met, then by that of the wall.
template <int D>
bool is_before(const Thick_meeting<D>& x, const Thick_meeting<D>& y);

/// \param swept where the corner of the wall that moves starts and ends, and its other corners
/// \param feature a point, or the two ends of an edge, which stand still
/// \param r finite, greater than 0
/// \param known another meeting, or none
/// \return none if this one is certainly later than that
/// \pre at the start the wall is at least that far from the feature; the hull of `swept` is not
/// Cost: ring numbers for each pair of features; that of is_apart() where the other is earlier.
template <int D>
std::optional<Thick_meeting<D>> first_meeting(
    const std::array<Point<D>, static_cast<std::size_t>(D) + 1>& swept, std::span<const Point<D>> feature,
    double r, const std::optional<Exact_time>& known = {});

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_THICK_WALL_H
