// SPDX-License-Identifier: LGPL-3.0-or-later
// Rooms that stand elsewhere than along the axes from the origin.
#ifndef CELLWALK_TESTS_BODY_PLACING_H
#define CELLWALK_TESTS_BODY_PLACING_H

#include <array>
#include <cstddef>

namespace cellwalk::test {

/// A rotation about the last axis, and its inverse; rounded.
inline constexpr double cosine = 0.8, sine = 0.6;
template <std::size_t D>
std::array<double, D> turned(std::array<double, D> x) {
  const double a = x[0], b = x[1];
  x[0] = cosine * a - sine * b;
  x[1] = sine * a + cosine * b;
  return x;
}
template <std::size_t D>
std::array<double, D> turned_back(std::array<double, D> x) {
  const double a = x[0], b = x[1];
  x[0] = cosine * a + sine * b;
  x[1] = cosine * b - sine * a;
  return x;
}

/// Where a room stands: turned, and off the origin along each axis.
struct Placing {
  bool is_turned = false;
  double offset = 0;
  double unit = 0;  ///< to multiples of which its points are rounded; 0: to doubles

  template <std::size_t D>
  std::array<double, D> placed(std::array<double, D> x) const {
    if (is_turned) x = turned(x);
    for (double& at : x) at += offset;
    return x;
  }
  template <std::size_t D>
  std::array<double, D> upright(std::array<double, D> x) const {
    for (double& at : x) at -= offset;
    return is_turned ? turned_back(x) : x;
  }
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_PLACING_H
