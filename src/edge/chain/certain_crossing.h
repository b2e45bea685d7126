// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to edge: a segment that crosses a triangle, proved in doubles.
#ifndef CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H
#define CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H

#include <algorithm>

#include "rounded_orientation.h"

namespace cellwalk::detail {

enum class Crossing_proof {
  crosses,  ///< the segment leads strictly from inside to outside, through the interior of the triangle
  misses,   ///< one of these signs is the other one
  none      ///< rounding leaves it open
};

/// A segment pq, against triangles whose corners a cell has in the order of a loop.
///
/// With corners a, b, c and d = q - p, all seen from p, the requested signs are those of det(d,a,b),
/// det(d,b,c), det(d,c,a), of S = det(a,b,c) at p, and of S - det(d,a,b) - det(d,b,c) - det(d,c,a) at q. The
/// last is in error by four times as much as the others, and by the roundings of three sums of numbers up to
/// 24 m^3, with all differences at most m.
class Certain_crossing {
 public:
  Certain_crossing(const Point<3>& p, const Point<3>& q)
      : p_(p), d_(seen_from_p(q)), most_(largest_size(d_)) {}

  /// Cost: some 70 operations.
  Crossing_proof operator()(const Point<3>& u, const Point<3>& v, const Point<3>& w) const {
    const Vector<3> a = seen_from_p(u), b = seen_from_p(v), c = seen_from_p(w);
    const double error = det_error<3>(std::max({most_, largest_size(a), largest_size(b), largest_size(c)}));
    const double ab = rounded_det(d_, a, b), bc = rounded_det(d_, b, c), ca = rounded_det(d_, c, a),
                 at_p = rounded_det(a, b, c);
    const double at_q = at_p - (ab + bc + ca);
    const double least = std::min({ab, bc, ca, at_p, -0.125 * at_q});
    if (least > error) return Crossing_proof::crosses;
    return least < -error ? Crossing_proof::misses : Crossing_proof::none;
  }

 private:
  Vector<3> seen_from_p(const Point<3>& x) const { return rounded_difference<3>(x, p_); }

  const Point<3>& p_;
  Vector<3> d_;
  double most_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CERTAIN_CROSSING_H
