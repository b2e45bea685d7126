// SPDX-License-Identifier: LGPL-3.0-or-later
// Closed facets, ridges and vertices as intersections of half-spaces, in exact numbers.
#ifndef CELLWALK_EDGE_EXACT_HALF_SPACE_H
#define CELLWALK_EDGE_EXACT_HALF_SPACE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstddef>

namespace cellwalk::detail {

template <int D>
using Ring_vector = std::array<Ring, static_cast<std::size_t>(D)>;

template <int D>
Ring_vector<D> exact(const Point<D>& x) {
  Ring_vector<D> r;
  for (int i = 0; i < D; ++i) r[i] = Ring(x[i]);
  return r;
}

template <std::size_t D>
std::array<Ring, D> minus(const std::array<Ring, D>& a, const std::array<Ring, D>& b) {
  std::array<Ring, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

template <std::size_t D>
std::array<Ring, D> negative(const std::array<Ring, D>& a) {
  std::array<Ring, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = -a[i];
  return r;
}

template <std::size_t D>
Ring exact_dot(const std::array<Ring, D>& a, const std::array<Ring, D>& b) {
  Ring r = a[0] * b[0];
  for (std::size_t i = 1; i < D; ++i) r += a[i] * b[i];
  return r;
}

inline Ring_vector<3> exact_cross(const Ring_vector<3>& a, const Ring_vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The point numerator / denominator. The denominator is positive.
template <int D>
struct Exact_point {
  Ring_vector<D> numerator;
  Ring denominator = Ring(1);

  /// Its coordinates, rounded towards 0.
  Point<D> rounded() const {
    Point<D> x;
    for (int i = 0; i < D; ++i) x[i] = to_double(Fraction(numerator[i], denominator));
    return x;
  }
  /// The vector from another point to this one, times the denominator.
  Ring_vector<D> from(const Ring_vector<D>& x) const {
    Ring_vector<D> r;
    for (int i = 0; i < D; ++i) r[i] = numerator[i] - denominator * x[i];
    return r;
  }
};

/// {x : (x - point) . normal >= 0}.
template <int D>
struct Half_space {
  Ring_vector<D> point, normal;

  Ring at(const Ring_vector<D>& x) const { return exact_dot(normal, minus(x, point)); }
  /// The same times the denominator of x.
  Ring at(const Exact_point<D>& x) const { return exact_dot(normal, x.from(point)); }
};

template <int D>
using Half_spaces = boost::container::small_vector<Half_space<D>, 6>;

/// The plane of facet i of a cell.
Half_space<2> plane_of(const Cell_view<2>& cell, std::size_t i);
Half_space<3> plane_of(const Cell_view<3>& cell, std::size_t i);

/// The half-space bounded by side k of facet i, whose plane is given. Within that plane the half-spaces of
/// all sides bound the closed facet.
Half_space<2> side_space(const Cell_view<2>& cell, std::size_t i, std::size_t k, const Half_space<2>& plane);
Half_space<3> side_space(const Cell_view<3>& cell, std::size_t i, std::size_t k, const Half_space<3>& plane);

/// Half-spaces whose intersection is closed facet i of a cell: its plane from both sides, then its sides.
Half_spaces<2> half_spaces(const Cell_view<2>& cell, std::size_t i);
Half_spaces<3> half_spaces(const Cell_view<3>& cell, std::size_t i);

/// The same for vertex k of facet i (2D), or its edge from vertex k to the next (3D).
Half_spaces<2> half_spaces_of_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k);
Half_spaces<3> half_spaces_of_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXACT_HALF_SPACE_H
