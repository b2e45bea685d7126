// SPDX-License-Identifier: LGPL-3.0-or-later
// Rounded determinants of orientations, with the magnitude that bounds their error.
#ifndef CELLWALK_INTERNAL_KERNEL_DETERMINANT_H
#define CELLWALK_INTERNAL_KERNEL_DETERMINANT_H

#include <cellwalk/kernel/point.h>

#include <cmath>

namespace cellwalk::detail {

/// Added to each inner product sum of a 3D magnitude: a product that underflows is wrong by at most 2^-1075,
/// which 16u times this allowance covers whatever the outer factor is.
inline constexpr double underflow_allowance = 1e-290;

/// The rounded determinant of a 2D orientation, and the sum of the magnitudes of its terms.
template <class T>
struct Determinant {
  T value;
  T magnitude;
};

template <class T>
inline Determinant<T> determinant(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const T ax = T(q[0]) - T(p[0]), ay = T(q[1]) - T(p[1]);
  const T bx = T(r[0]) - T(p[0]), by = T(r[1]) - T(p[1]);
  const T left = ax * by, right = ay * bx;
  return {left - right, std::abs(left) + std::abs(right)};
}

template <class T>
inline Determinant<T> determinant(const Point<3>& p, const Point<3>& q, const Point<3>& r,
                                  const Point<3>& s) {
  const T ax = T(q[0]) - T(p[0]), ay = T(q[1]) - T(p[1]), az = T(q[2]) - T(p[2]);
  const T bx = T(r[0]) - T(p[0]), by = T(r[1]) - T(p[1]), bz = T(r[2]) - T(p[2]);
  const T cx = T(s[0]) - T(p[0]), cy = T(s[1]) - T(p[1]), cz = T(s[2]) - T(p[2]);
  const T ab = ax * by, ba = ay * bx, bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax;
  const T value = (ab - ba) * cz + (bc - cb) * az + (ca - ac) * bz;
  const T tiny = T(underflow_allowance);
  const T magnitude = (std::abs(ab) + std::abs(ba) + tiny) * std::abs(cz) +
                      (std::abs(bc) + std::abs(cb) + tiny) * std::abs(az) +
                      (std::abs(ca) + std::abs(ac) + tiny) * std::abs(bz);
  return {value, magnitude};
}

template <class T>
inline int sign_of(T x) {
  return (x > T(0)) - (x < T(0));
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_DETERMINANT_H
