// SPDX-License-Identifier: LGPL-3.0-or-later
// Orientations in whole numbers, exact wherever the coordinates along each axis are multiples of 2^-59 of the
// power of two below the largest of them. Then they are whole numbers below 2^60 in this unit, which does not
// change the sign. Points that lie in one plane have the sign 0 by them at the cost of some doubles, where
// numbers of any length would take microseconds.
#ifndef CELLWALK_KERNEL_INTEGER_ORIENTATION_H
#define CELLWALK_KERNEL_INTEGER_ORIENTATION_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk::detail {

__extension__ using Integer = __int128;  // not of ISO C++

/// Coordinates of N points along an axis, as whole numbers below 2^60.
template <std::size_t N>
using Whole_coordinates = std::array<std::int64_t, N>;

/// False unless the coordinates are whole numbers in one unit.
/// \pre they are finite
template <std::size_t N>
bool to_whole(const std::array<double, N>& x, Whole_coordinates<N>& whole) {
  double largest = 0;
  for (const double value : x) largest = std::max(largest, std::abs(value));
  // Scaling up by a power of two is exact. Where it would scale down small values might vanish.
  constexpr int bits = 60, bias = 1023, least_exponent = -900;
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - bias;
  if (exponent < least_exponent || exponent >= bits) return false;  // or not a number
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(bits - 1 - exponent + bias) << 52);
  bool are_whole = true;
  for (std::size_t i = 0; i < N; ++i) {
    const double scaled = scale * x[i];
    whole[i] = static_cast<std::int64_t>(scaled);
    are_whole &= static_cast<double>(whole[i]) == scaled;
  }
  return are_whole;
}

inline int sign_of_integer(Integer x) { return (x > 0) - (x < 0); }

/// The sign of the orientation of points whose coordinates along each axis are whole numbers in one unit.
/// None of others.
inline std::optional<int> integer_orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  Whole_coordinates<3> x, y;
  if (!to_whole<3>({p[0], q[0], r[0]}, x) || !to_whole<3>({p[1], q[1], r[1]}, y)) return {};
  return sign_of_integer(Integer(x[1] - x[0]) * (y[2] - y[0]) - Integer(y[1] - y[0]) * (x[2] - x[0]));
}

inline std::optional<int> integer_orientation(const Point<3>& p, const Point<3>& q, const Point<3>& r,
                                              const Point<3>& s) {
  std::array<Whole_coordinates<4>, 3> x;
  for (std::size_t k = 0; k < 3; ++k)
    if (!to_whole<4>({p[k], q[k], r[k], s[k]}, x[k])) return {};
  // The differences are below 2^61, the minors below 2^123. The products of their upper halves, in units of
  // 2^64, add up to less than 2^123, those of their lower halves to less than 2^127.
  Integer high = 0, low = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &u = x[(k + 1) % 3], &v = x[(k + 2) % 3];
    const Integer minor = Integer(u[1] - u[0]) * (v[2] - v[0]) - Integer(v[1] - v[0]) * (u[2] - u[0]);
    const std::int64_t height = x[k][3] - x[k][0];
    high += (minor >> 64) * height;
    low += Integer(static_cast<std::uint64_t>(minor)) * height;
  }
  high += low >> 64;
  return high != 0 ? sign_of_integer(high) : static_cast<std::uint64_t>(low) != 0;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_INTEGER_ORIENTATION_H
