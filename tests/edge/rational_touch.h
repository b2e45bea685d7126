// SPDX-License-Identifier: LGPL-3.0-or-later
// When a swept triangle first meets an obstacle, touches included, in rational arithmetic: shares nothing
// with the library.
#ifndef CELLWALK_TESTS_EDGE_RATIONAL_TOUCH_H
#define CELLWALK_TESTS_EDGE_RATIONAL_TOUCH_H

#include <cellwalk/kernel/point.h>

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <optional>
#include <span>

namespace cellwalk::test {

using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

/// How a closed set that moves meets a closed obstacle.
struct Rational_touch {
  bool at_start = false;  ///< before it moves
  /// The infimum of the times at which a point that was not in the set at the start meets the obstacle. None:
  /// only points that were may meet it.
  std::optional<Rational> later;

  bool any() const { return at_start || later; }
};

/// The edge from a + s (b - a) to q, against an obstacle of two points (a segment) or three (a triangle).
/// \pre the points of the obstacle do not lie on one line (segment: differ)
Rational_touch touch_of_edge(const Point<3>& a, const Point<3>& b, const Point<3>& q,
                             std::span<const Point<3>> obstacle);

/// The same for the point a + s (b - a) alone.
Rational_touch touch_of_point(const Point<3>& a, const Point<3>& b, std::span<const Point<3>> obstacle);

/// True if the closed segment uv meets the obstacle.
bool segment_meets(const Point<3>& u, const Point<3>& v, std::span<const Point<3>> obstacle);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_RATIONAL_TOUCH_H
