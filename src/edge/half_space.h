// SPDX-License-Identifier: LGPL-3.0-or-later
// Closed facets, ridges and vertices as intersections of half-spaces, in rationals.
#ifndef CELLWALK_EDGE_HALF_SPACE_H
#define CELLWALK_EDGE_HALF_SPACE_H

#include <cellwalk/environment/cell_shape.h>
#include <cellwalk/kernel/exact_value.h>

#include <array>
#include <cstddef>
#include <vector>

namespace cellwalk::detail {

template <int D>
using Rational_point = std::array<Rational, static_cast<std::size_t>(D)>;

template <int D>
Rational_point<D> exact(const Point<D>& x) {
  Rational_point<D> r;
  for (int i = 0; i < D; ++i) r[i] = Rational(x[i]);
  return r;
}

template <std::size_t D>
std::array<Rational, D> minus(const std::array<Rational, D>& a, const std::array<Rational, D>& b) {
  std::array<Rational, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

template <std::size_t D>
Rational exact_dot(const std::array<Rational, D>& a, const std::array<Rational, D>& b) {
  Rational r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

inline Rational_point<3> exact_cross(const Rational_point<3>& a, const Rational_point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// {x : (x - point) . normal >= 0}.
template <int D>
struct Half_space {
  Rational_point<D> point, normal;

  Rational at(const Rational_point<D>& x) const { return exact_dot(normal, minus(x, point)); }
};

/// Half-spaces whose intersection is closed facet i of a cell: its plane from both sides, then its sides.
std::vector<Half_space<2>> half_spaces(const Cell_view<2>& cell, std::size_t i);
std::vector<Half_space<3>> half_spaces(const Cell_view<3>& cell, std::size_t i);

/// The same for vertex k of facet i (2D), or its edge from vertex k to the next (3D).
std::vector<Half_space<2>> half_spaces_of_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k);
std::vector<Half_space<3>> half_spaces_of_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_HALF_SPACE_H
