// SPDX-License-Identifier: LGPL-3.0-or-later
// When a point or an edge comes nearer to a wall than its radius, as the root of a quadratic polynomial.
// Theory: docs/radius.md, times.
#ifndef CELLWALK_EDGE_THICK_NEAR_TIME_H
#define CELLWALK_EDGE_THICK_NEAR_TIME_H

#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/exact_root.h>
#include <cellwalk/walk/contact.h>

#include <span>

namespace cellwalk::detail {

/// The last time at which a motion is free of a wall, and the features that are nearest then.
struct Near_time {
  Exact_root root;
  Body_feature body;  ///< the vertex, or the edge elsewhere
  Feature of_wall;
};

/// The order of contacts at one time.
bool is_before(const Near_time& x, const Near_time& y);

/// \param wall the corners of a wall, in order; of a facet the first three are not collinear
/// \pre where the motion starts, it is at least as far from the wall as its radius; the hull of the motion is
///        nearer
/// Cost: ring numbers for each feature of the wall.
template <int D>
Near_time find_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_TIME_H
