// SPDX-License-Identifier: LGPL-3.0-or-later
// Points and vectors: plain arrays of doubles, so that positions can be read in place.
#ifndef CELLWALK_KERNEL_POINT_H
#define CELLWALK_KERNEL_POINT_H

#include <array>
#include <cmath>
#include <cstddef>

namespace cellwalk {

/// A point in D dimensions, in the units of the environment. Every coordinate is exact input and is never
/// rounded. (The cast keeps D out of argument deduction, where int and the size type of an array would
/// conflict.)
template <int D>
using Point = std::array<double, static_cast<std::size_t>(D)>;

/// A direction or displacement in D dimensions.
template <int D>
using Vector = std::array<double, static_cast<std::size_t>(D)>;

/// a - b, rounded.
template <std::size_t D>
std::array<double, D> operator-(const std::array<double, D>& a, const std::array<double, D>& b) {
  std::array<double, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

/// a + b, rounded.
template <std::size_t D>
std::array<double, D> operator+(const std::array<double, D>& a, const std::array<double, D>& b) {
  std::array<double, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] + b[i];
  return r;
}

/// s * a, rounded.
template <std::size_t D>
std::array<double, D> operator*(double s, const std::array<double, D>& a) {
  std::array<double, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = s * a[i];
  return r;
}

/// The scalar product, rounded.
template <std::size_t D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

/// The cross product, rounded.
inline Vector<3> cross(const Vector<3>& a, const Vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The Euclidean length, rounded.
template <std::size_t D>
double length(const std::array<double, D>& a) {
  return std::sqrt(dot(a, a));
}

/// v over its length, rounded.
/// \pre in doubles, the square of the length is neither 0 nor infinite
template <std::size_t D>
std::array<double, D> normalized(const std::array<double, D>& v) {
  return (1 / length(v)) * v;
}

/// As normalized(v), but `otherwise` where the length is 0.
template <std::size_t D>
std::array<double, D> normalized(const std::array<double, D>& v, const std::array<double, D>& otherwise) {
  const double l = length(v);
  return l > 0 ? (1 / l) * v : otherwise;
}

/// True if every coordinate is finite.
template <std::size_t D>
bool is_finite(const std::array<double, D>& a) {
  for (double x : a)
    if (!std::isfinite(x)) return false;
  return true;
}

}  // namespace cellwalk

// Exactness rests on IEEE arithmetic, also in code that includes the headers. (gcc has
// -funsafe-math-optimizations define the last two, clang only the first.)
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "cellwalk decides exactly and needs IEEE arithmetic: compile without -ffast-math, -Ofast and the like"
#endif

#endif  // CELLWALK_KERNEL_POINT_H
