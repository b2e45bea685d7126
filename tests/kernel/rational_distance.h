// SPDX-License-Identifier: LGPL-3.0-or-later
// The distance of two convex hulls in rational arithmetic, as the least norm of their Minkowski difference:
// no features and no directions, hence nothing in common with the library.
#ifndef CELLWALK_TESTS_KERNEL_RATIONAL_DISTANCE_H
#define CELLWALK_TESTS_KERNEL_RATIONAL_DISTANCE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernel/rational_meeting.h"

namespace cellwalk::test {

template <std::size_t D>
using Rational_point = std::array<Fraction, D>;

template <std::size_t D>
Rational_point<D> to_rational_point(const std::array<double, D>& x) {
  Rational_point<D> r;
  for (std::size_t k = 0; k < D; ++k) r[k] = Fraction(x[k]);
  return r;
}

/// The points of a hull.
template <int D>
using Hull = std::vector<Rational_point<static_cast<std::size_t>(D)>>;

template <int D>
Hull<D> to_hull(std::span<const Point<D>> points) {
  Hull<D> hull;
  for (const Point<D>& x : points) hull.push_back(to_rational_point(x));
  return hull;
}

/// The point of a motion at a time.
template <std::size_t D>
Rational_point<D> at_time(const std::array<double, D>& from, const std::array<double, D>& target,
                          const Fraction& time) {
  Rational_point<D> r;
  for (std::size_t k = 0; k < D; ++k)
    r[k] = Fraction(from[k]) + time * (Fraction(target[k]) - Fraction(from[k]));
  return r;
}

/// The shortest vector from one hull to another, and the square of its length.
template <int D>
struct Shortest {
  Rational_point<static_cast<std::size_t>(D)> vector;
  Fraction square;
};

/// Active sets: a point x of the difference is the one of least norm if v.x >= x.x for all its corners v.
/// \pre no hull is empty
template <int D>
Shortest<D> shortest_vector(const Hull<D>& a, const Hull<D>& b);

/// True if the square root of x is at least r, for r >= 0.
inline bool root_is_at_least(const Fraction& x, double r) { return x >= Fraction(r) * Fraction(r); }

/// The square root of x if it is a double.
std::optional<double> double_root(const Fraction& x);

/// The greatest double that is not above the square root of x.
/// \pre that root is at most the greatest double
double root_rounded_down(const Fraction& x);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_KERNEL_RATIONAL_DISTANCE_H
