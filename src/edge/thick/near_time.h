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
  Feature of_motion;  ///< of its corners: 0 is the one that moves, 1 is q, 2 the third one
  Feature of_wall;
};

/// The order of contacts by time, then by features.
bool is_before(const Near_time& x, const Near_time& y);

/// \param motion of a vertex, an edge or a face
/// \param wall a point, the two ends of a segment, or the corners of a wall in order, of which the first
///        three are not collinear
/// \param about approximate_near_time(), or any other number: only the cost depends on it
/// \pre where the motion starts, it is at least as far from the wall as its radius; the hull of the motion is
///        nearer
/// Cost: some us of intervals, and ring numbers for the features that meet at about the same time; for all
/// where rounding hides the time.
template <int D>
Near_time find_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double about);

/// About when that is, in doubles; infinity if rounding hides it.
template <int D>
double approximate_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall);

/// True proves that a wall is no reason to stop before a contact that is known, nor at it: what is swept
/// until the next double after its time keeps the distance.
/// \param time of the contact, rounded down
/// Cost: that of is_apart().
template <int D>
bool is_later(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double time);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_TIME_H
