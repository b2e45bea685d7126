// SPDX-License-Identifier: LGPL-3.0-or-later
// An obstacle edge as the rim of a membrane, for queries of edges that move one end after the other.
#ifndef CELLWALK_TESTS_EDGE_MEMBRANE_OF_EDGE_H
#define CELLWALK_TESTS_EDGE_MEMBRANE_OF_EDGE_H

#include <optional>
#include <span>
#include <vector>

#include "edge/rational_touch.h"

namespace cellwalk::test {

/// The edge pq moves from p0 q0 to p1 q1: p first, while q stands still, then q.
struct Edge_motion {
  Point<3> p0, p1, q0, q1;

  /// The same motion, but q moves first.
  Edge_motion q_first() const { return {q0, q1, p0, p1}; }
};

/// What the motion meets, p first.
struct Edge_touch {
  Rational_touch first, second;  ///< while p moves; while q moves then
  bool sides = false;            ///< one of the sides of the two swept triangles meets the obstacle

  bool any() const { return first.any() || second.any(); }
};

Edge_touch touch_of_motion(const Edge_motion& motion, std::span<const Point<3>> obstacle);

/// The triangle abc, its corner c such that to the motion, whichever end moves first, it is what its rim ab
/// is: a motion that meets it meets ab, and so do the start of the motion and the sides of the swept
/// triangles.
struct Membrane_of_edge {
  std::array<Point<3>, 3> triangle;
  int halvings = 0;  ///< its height is the length of ab, halved so often
};

/// Tries c at right angles to ab above its middle: away from the motion, toward both sides, toward it; then
/// at half the height, and so on. What does not meet ab has a distance from it, so some height is small
/// enough but for the rounding of c; where ab meets something, only the direction may matter. No value if
/// none will do.
/// \pre a and b differ
std::optional<Membrane_of_edge> membrane_of_edge(const Point<3>& a, const Point<3>& b,
                                                 const Edge_motion& motion);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_MEMBRANE_OF_EDGE_H
