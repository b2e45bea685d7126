// SPDX-License-Identifier: LGPL-3.0-or-later
// Normals by doubles, intervals or exact numbers, and tests of points in segments and polygons.
#include <cellwalk/internal/kernel/exact_value.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cellwalk {
namespace {

Point<2> drop(const Point<3>& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// The sign of an orientation if the filter decides it, otherwise 0.
int filtered_sign(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const auto d = detail::determinant<double>(p, q, r);
  const double bound = detail::orientation_error * d.magnitude;
  if (!(d.magnitude > detail::smallest_magnitude && d.magnitude < detail::largest_magnitude)) return 0;
  return d.value > bound ? 1 : d.value < -bound ? -1 : 0;
}

/// The value of a plane or line function at x, in any ordered field.
template <class T>
T value(const Point<2>& u, const Point<2>& v, const Point<2>& x) {
  const T ux(u[0]), uy(u[1]);
  return (T(v[0]) - ux) * (T(x[1]) - uy) - (T(v[1]) - uy) * (T(x[0]) - ux);
}

template <class T>
T value(const Point<3>& u, const Point<3>& v, const Point<3>& w, const Point<3>& x) {
  const T ux(u[0]), uy(u[1]), uz(u[2]);
  const T ax = T(v[0]) - ux, ay = T(v[1]) - uy, az = T(v[2]) - uz;
  const T bx = T(w[0]) - ux, by = T(w[1]) - uy, bz = T(w[2]) - uz;
  return (ay * bz - az * by) * (T(x[0]) - ux) + (az * bx - ax * bz) * (T(x[1]) - uy) +
         (ax * by - ay * bx) * (T(x[2]) - uz);
}

/// A normal of the line uv, or the plane uvw, in any ordered field.
template <class T>
std::array<T, 2> normal(const Point<2>& u, const Point<2>& v) {
  return {T(u[1]) - T(v[1]), T(v[0]) - T(u[0])};
}

template <class T>
std::array<T, 3> normal(const Point<3>& u, const Point<3>& v, const Point<3>& w) {
  const T ux(u[0]), uy(u[1]), uz(u[2]);
  const T ax = T(v[0]) - ux, ay = T(v[1]) - uy, az = T(v[2]) - uz;
  const T bx = T(w[0]) - ux, by = T(w[1]) - uy, bz = T(w[2]) - uz;
  return {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
}

/// Components with a larger error, relative to the largest, are recomputed by intervals, then exactly.
constexpr double normal_width = 0x1p-49;

/// Between these bounds the squares of components neither overflow nor lose digits.
constexpr double least_plain = 0x1p-300, largest_plain = 0x1p300;

/// Scaled to length 1; 0 stays 0.
template <std::size_t D>
std::array<double, D> of_length_1(std::array<double, D> n) {
  double largest = 0, squares = 0;
  for (const double x : n) largest = std::max(largest, std::abs(x));
  if (largest == 0) return n;
  if (!(largest > least_plain && largest < largest_plain)) {
    const int exponent = std::ilogb(largest);
    for (double& x : n) x = std::ldexp(x, -exponent);
  }
  for (const double x : n) squares += x * x;
  const double norm = std::sqrt(squares);
  for (double& x : n) x = x / norm + 0.0;  // no negative zeros for readers of tables
  return n;
}

/// A normal in doubles, and the error bound of its components relative to the largest: products of
/// differences are off by less than four roundings of each term.
inline std::pair<Vector<2>, double> plain_normal(const Point<2>& u, const Point<2>& v) {
  const Vector<2> n = normal<double>(u, v);
  const double largest = std::max(std::abs(n[0]), std::abs(n[1]));
  return {n, largest > least_plain && largest < largest_plain ? 0x1p-53 : 1};
}
inline std::pair<Vector<3>, double> plain_normal(const Point<3>& u, const Point<3>& v, const Point<3>& w) {
  const Vector<3> a = v - u, b = w - u;
  Vector<3> n;
  double terms = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = a[j] * b[k] - a[k] * b[j];
    terms = std::max(terms, std::abs(a[j] * b[k]) + std::abs(a[k] * b[j]));
    largest = std::max(largest, std::abs(n[i]));
  }
  const bool is_in_range = largest > least_plain && largest < largest_plain;
  return {n, is_in_range ? 4 * 0x1p-53 * (terms / largest) : 1};
}

using Interval = CGAL::Interval_nt<false>;

/// The rounding mode is set once for all operations. Not to be inlined, so that nothing else is computed in
/// that mode.
template <class... P>
[[gnu::noinline]] std::array<Interval, sizeof...(P)> interval_normal(const P&... points) {
  const Interval::Protector protector;
  return normal<Interval>(points...);
}

template <class... P>
std::array<double, sizeof...(P)> unit_normal_of(const P&... points) {
  constexpr std::size_t D = sizeof...(P);
  const auto [plain, error] = plain_normal(points...);
  if (error <= normal_width) return of_length_1(plain);
  std::array<double, D> n;
  {
    const auto wide = interval_normal(points...);
    double width = 0, largest = 0;
    for (std::size_t i = 0; i < D; ++i) {
      n[i] = wide[i].inf() + (wide[i].sup() - wide[i].inf()) / 2;
      width = std::max(width, wide[i].sup() - wide[i].inf());
      largest = std::max(largest, std::abs(n[i]));
    }
    if (width <= normal_width * largest && largest > 0 && std::isfinite(largest)) return of_length_1(n);
  }
  const auto exact = normal<Rational>(points...);
  Rational largest = 0;
  for (const Rational& x : exact) largest = std::max<Rational>(largest, abs(x));
  if (largest == 0) return {};
  for (std::size_t i = 0; i < D; ++i) n[i] = CGAL::to_double(Rational(exact[i] / largest));
  return of_length_1(n);
}

}  // namespace

int displaced_side(const Point<2>& p, const Point<2>& q) {
  // The signs of the components of the normal (p_y - q_y, q_x - p_x).
  const int first = p[1] > q[1] ? 1 : p[1] < q[1] ? -1 : 0;
  return first != 0 ? first : q[0] > p[0] ? 1 : q[0] < p[0] ? -1 : 0;
}

int displaced_side(const Point<3>& p, const Point<3>& q, const Point<3>& r) {
  // The components of (q - p) x (r - p) are the areas of the triangle projected along the axes.
  Predicate_counts counts;
  for (int axis = 0; axis < 3; ++axis)
    if (const int sign = Exact::orientation(counts, drop(p, axis), drop(q, axis), drop(r, axis)); sign != 0)
      return sign;
  return 0;
}

bool are_collinear(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return filtered_sign(p, q, r) == 0 && detail::orientation_cgal(p, q, r) == 0;
}

bool are_collinear(const Point<3>& p, const Point<3>& q, const Point<3>& r) {
  for (int axis = 0; axis < 3; ++axis)
    if (filtered_sign(drop(p, axis), drop(q, axis), drop(r, axis)) != 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (detail::orientation_cgal(drop(p, axis), drop(q, axis), drop(r, axis)) != 0) return false;
  return true;
}

template <int D>
bool on_segment(const Point<D>& u, const Point<D>& v, const Point<D>& x) {
  for (int i = 0; i < D; ++i)
    if (x[i] < std::min(u[i], v[i]) || x[i] > std::max(u[i], v[i])) return false;
  return are_collinear(u, v, x);
}

template bool on_segment<2>(const Point<2>&, const Point<2>&, const Point<2>&);
template bool on_segment<3>(const Point<3>&, const Point<3>&, const Point<3>&);

bool in_convex_polygon(std::span<const Point<3>> polygon, const Point<3>& x) {
  Predicate_counts counts;
  for (int axis = 0; axis < 3; ++axis) {
    // The projection along an axis is one-to-one on the plane if the projected polygon has a positive area.
    const int turn =
        Exact::orientation(counts, drop(polygon[0], axis), drop(polygon[1], axis), drop(polygon[2], axis));
    if (turn == 0) continue;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point<3>& next = polygon[k + 1 == polygon.size() ? 0 : k + 1];
      if (turn * Exact::orientation(counts, drop(polygon[k], axis), drop(next, axis), drop(x, axis)) < 0)
        return false;
    }
    return true;
  }
  return false;
}

Vector<2> unit_normal(const Point<2>& u, const Point<2>& v) { return Vector<2>(unit_normal_of(u, v)); }

Vector<3> unit_normal(const Point<3>& u, const Point<3>& v, const Point<3>& w) {
  return Vector<3>(unit_normal_of(u, v, w));
}

template <int D>
Point<D> point_on(const Point<D>& a, const Point<D>& b, double t) {
  Point<D> p;
  for (int i = 0; i < D; ++i) {
    const double difference = b[i] - a[i];
    p[i] = std::isfinite(difference) ? a[i] + t * difference : (1 - t) * a[i] + t * b[i];
  }
  return p;
}

template Point<2> point_on<2>(const Point<2>&, const Point<2>&, double);
template Point<3> point_on<3>(const Point<3>&, const Point<3>&, double);

Ring Exact_value::orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return value<Ring>(p, q, r);
}

Ring Exact_value::orientation(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  return value<Ring>(p, q, r, s);
}

}  // namespace cellwalk
