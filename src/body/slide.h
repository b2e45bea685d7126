// SPDX-License-Identifier: LGPL-3.0-or-later
// How a motion goes on along walls.
#ifndef CELLWALK_BODY_SLIDE_H
#define CELLWALK_BODY_SLIDE_H

#include <cellwalk/kernel/point.h>

#include "stop_candidates.h"

namespace cellwalk::detail {

/// How far a new move is lifted off the wall it starts from. Rounding of a position and of a projected motion is a few ulp
/// each; a lift that is too small only costs another contact, since every move is checked exactly.
constexpr double lift_ulps = 16;

/// The lift of a motion from a position at a wall, along the normal of that. At the origin, where doubles are as near to each other
/// as they get anywhere, the motion says what a few ulp are: so the lift is in proportion to the environment.
template <int D>
Vector<D> lift(const Point<D>& position, const Vector<D>& motion, const Vector<D>& normal) {
  return (lift_ulps * ulp<D>(position == Point<D>{} ? motion : position)) * normal;
}

/// The part of a motion that two walls leave: none in the plane, that along their edge in space.
inline Vector<2> along_both(const Vector<2>&, const Vector<2>&, const Vector<2>&) { return {}; }
inline Vector<3> along_both(const Vector<3>& v, const Vector<3>& n, const Vector<3>& m) {
  const Vector<3> edge = cross(n, m);
  const double square = dot(edge, edge);
  return square > 0 ? (dot(v, edge) / square) * edge : Vector<3>{};
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_SLIDE_H
