// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to edge: a segment that crosses a triangle, proved in doubles.
#ifndef CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H
#define CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::detail {

enum class Crossing_proof {
  crosses,  ///< the segment leads strictly from inside to outside, through the interior of the triangle
  misses,   ///< one of these signs is the other one
  none      ///< rounding leaves it open
};

/// A segment pq, against triangles whose corners a cell has in the order of a loop.
///
/// With corners a, b, c and d = q - p, all seen from p, the signs asked for are those of det(d,a,b),
/// det(d,b,c), det(d,c,a), of S = det(a,b,c) at p, and of S - det(d,a,b) - det(d,b,c) - det(d,c,a) at q. Each
/// of the first four is a sum of six products of three differences. A term takes at most eight roundings to
/// nearest (three differences, two products, three sums), so with u = 2^-53 and all differences at most m in
/// magnitude, the error is at most 6 * 8.1 u m^3 < 2^-47 m^3. The last is in error by four times that, and by
/// the roundings of three sums of numbers up to 24 m^3.
class Certain_crossing {
 public:
  Certain_crossing(const Point<3>& p, const Point<3>& q) : p_(p), d_(seen_from_p(q)), most_(magnitude(d_)) {}

  /// Cost: some 70 operations.
  Crossing_proof operator()(const Point<3>& u, const Point<3>& v, const Point<3>& w) const {
    const Vector<3> a = seen_from_p(u), b = seen_from_p(v), c = seen_from_p(w);
    const double m = std::max({most_, magnitude(a), magnitude(b), magnitude(c)});
    const double error = 0x1p-47 * (m * m * m);
    // Products below the least normal double would have an error of their own.
    if (!(error > 0x1p-900 && error < 0x1p900)) return Crossing_proof::none;
    const double ab = det(d_, a, b), bc = det(d_, b, c), ca = det(d_, c, a), at_p = det(a, b, c);
    const double at_q = at_p - (ab + bc + ca);
    const double least = std::min({ab, bc, ca, at_p, -0.125 * at_q});
    if (least > error) return Crossing_proof::crosses;
    return least < -error ? Crossing_proof::misses : Crossing_proof::none;
  }

 private:
  Vector<3> seen_from_p(const Point<3>& x) const { return {x[0] - p_[0], x[1] - p_[1], x[2] - p_[2]}; }
  static double magnitude(const Vector<3>& x) {
    return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }
  static double det(const Vector<3>& x, const Vector<3>& y, const Vector<3>& z) {
    return (x[1] * y[2] - x[2] * y[1]) * z[0] + (x[2] * y[0] - x[0] * y[2]) * z[1] +
           (x[0] * y[1] - x[1] * y[0]) * z[2];
  }

  const Point<3>& p_;
  Vector<3> d_;
  double most_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H
