// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/membrane_of_edge.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <cmath>

namespace cellwalk::test {
namespace {

/// The height is then 2^-40 of the length: far above the rounding of c, far below what the queries need.
constexpr int most_halvings = 40;

/// A unit vector at right angles to a unit vector, away from a point as seen from another one.
Vector<3> away_from(const Point<3>& there, const Point<3>& here, const Vector<3>& along) {
  const Vector<3> path = here - there;
  Vector<3> away = path - dot(path, along) * along;
  if (length(away) <= 0x1p-20 * length(path)) {
    // Straight ahead or no way at all: any direction at right angles.
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(along[i]) < std::abs(along[axis])) axis = i;
    Vector<3> unit_of_axis{};
    unit_of_axis[axis] = 1;
    away = cross(along, unit_of_axis);
  }
  return normalized(away);
}

bool agree(const Edge_touch& x, const Edge_touch& y) {
  return x.any() == y.any() && x.first.at_start == y.first.at_start && x.sides == y.sides;
}

}  // namespace

Edge_touch touch_of_motion(const Edge_motion& m, std::span<const Point<3>> obstacle) {
  Edge_touch touch;
  touch.first = touch_of_edge(m.p0, m.p1, m.q0, obstacle);
  touch.second = touch_of_edge(m.q0, m.q1, m.p1, obstacle);
  touch.sides = segment_meets(m.p0, m.q0, obstacle) || segment_meets(m.p0, m.p1, obstacle) ||
                segment_meets(m.p1, m.q0, obstacle) || segment_meets(m.q0, m.q1, obstacle) ||
                segment_meets(m.p1, m.q1, obstacle);
  return touch;
}

std::optional<Membrane_of_edge> membrane_of_edge(const Point<3>& a, const Point<3>& b,
                                                 const Edge_motion& motion) {
  const std::array<Point<3>, 2> edge{a, b};
  const Edge_touch p_first = touch_of_motion(motion, edge);
  const Edge_touch q_first = touch_of_motion(motion.q_first(), edge);
  const Point<3> middle = a + 0.5 * (b - a);
  const Point<3> of_motion = 0.25 * ((motion.p0 + motion.p1) + (motion.q0 + motion.q1));
  const Vector<3> along = normalized(b - a), away = away_from(of_motion, middle, along),
                  side = cross(along, away);
  for (int halvings = 0; halvings <= most_halvings; ++halvings) {
    const double height = std::ldexp(length(b - a), -halvings);
    for (const Vector<3>& direction : {away, side, -1.0 * side, -1.0 * away}) {
      const std::array<Point<3>, 3> triangle{a, b, middle + height * direction};
      if (are_collinear(triangle[0], triangle[1], triangle[2])) continue;
      if (agree(touch_of_motion(motion, triangle), p_first) &&
          agree(touch_of_motion(motion.q_first(), triangle), q_first))
        return Membrane_of_edge{triangle, halvings};
    }
  }
  return {};
}

}  // namespace cellwalk::test
