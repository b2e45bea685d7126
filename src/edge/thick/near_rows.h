// SPDX-License-Identifier: LGPL-3.0-or-later
// The pairs of a feature of a motion and one of a wall, each with a polynomial and the conditions for its
// roots, in any type of numbers. Theory: docs/radius.md, times and faces.
#ifndef CELLWALK_EDGE_THICK_NEAR_ROWS_H
#define CELLWALK_EDGE_THICK_NEAR_ROWS_H

#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/kernel/distance.h>

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace cellwalk::detail {

/// square s^2 + linear s + constant, of the time s.
template <class N>
struct Polynomial {
  N square, linear, constant;

  friend Polynomial operator-(const Polynomial& p, const Polynomial& q) {
    return {N(p.square - q.square), N(p.linear - q.linear), N(p.constant - q.constant)};
  }
  friend Polynomial operator*(const N& factor, const Polynomial& p) {
    return {N(factor * p.square), N(factor * p.linear), N(factor * p.constant)};
  }
};

/// The square of one of degree 1.
template <class N>
Polynomial<N> squared(const Polynomial<N>& p) {
  return {N(p.linear * p.linear), N(N(2) * p.linear * p.constant), N(p.constant * p.constant)};
}

/// A vector that changes evenly with time.
template <int D, class N>
struct Moving_vector {
  std::array<N, static_cast<std::size_t>(D)> at_0, rate{};
};

/// x - y for points that stand still.
template <int D, class N>
Moving_vector<D, N> between(const Point<D>& x, const Point<D>& y) {
  Moving_vector<D, N> result;
  for (std::size_t k = 0; k < D; ++k) {
    result.at_0[k] = N(N(x[k]) - N(y[k]));
    result.rate[k] = N(0);
  }
  return result;
}

template <std::size_t D, class N>
N product_of(const std::array<N, D>& x, const std::array<N, D>& y) {
  N sum(x[0] * y[0]);
  for (std::size_t k = 1; k < D; ++k) sum = N(sum + x[k] * y[k]);
  return sum;
}

template <int D, class N>
Polynomial<N> scalar_product(const Moving_vector<D, N>& x, const Moving_vector<D, N>& y) {
  return {product_of(x.rate, y.rate), N(product_of(x.at_0, y.rate) + product_of(x.rate, y.at_0)),
          product_of(x.at_0, y.at_0)};
}

/// \pre one of them stands still
template <class N>
Moving_vector<3, N> vector_product(const Moving_vector<3, N>& x, const Moving_vector<3, N>& y) {
  Moving_vector<3, N> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    result.at_0[k] = N(x.at_0[i] * y.at_0[j] - x.at_0[j] * y.at_0[i]);
    result.rate[k] = N(N(x.at_0[i] * y.rate[j] - x.at_0[j] * y.rate[i]) +
                       N(x.rate[i] * y.at_0[j] - x.rate[j] * y.at_0[i]));
  }
  return result;
}

/// A feature of the motion, of whose corners 0 is the one that moves, 1 is q and 2 the third one, and one of
/// the wall.
struct Near_row {
  Feature of_motion, of_wall;
};

using Near_rows = boost::container::small_vector<Near_row, 24>;

/// All of a motion and a wall.
template <int D>
Near_rows rows_of(const Thick_motion<D>& motion, std::size_t wall_corners);

/// The time of a row is a root of the polynomial at which some others are at least 0, and some greater.
template <class N>
struct Near_equation {
  Polynomial<N> polynomial;
  boost::container::small_vector<Polynomial<N>, 8> at_least_0{}, above_0{};
};

template <int D, class N>
class Near_equations {
 public:
  Near_equations(const Thick_motion<D>& motion, std::span<const Point<D>> wall)
      : motion_(motion), wall_(wall), square_of_radius_(N(motion.radius) * N(motion.radius)) {}

  Near_equation<N> of(const Near_row& row) const { return equation_of(row, true); }
  /// Without its conditions.
  Polynomial<N> polynomial_of(const Near_row& row) const { return equation_of(row, false).polynomial; }

 private:
  Near_equation<N> equation_of(const Near_row& row, bool conditions) const {
    const Point<D>& c = wall_[row.of_wall.corners[0]];
    if (row.of_wall.size == 1) {
      if (row.of_motion.size == 1) return vertex_and_vertex(c);
      if (row.of_motion.size == 2) return edge_and_vertex(still(row), c, conditions);
    }
    if constexpr (D == 3) {
      if (row.of_wall.size == 1) return face_and_vertex(c, conditions);
      if (row.of_wall.size == 3) return vertex_and_facet(conditions);
    }
    const Point<D>& end = wall_[row.of_wall.corners[1]];
    if constexpr (D == 3)
      if (row.of_motion.size == 2) return edge_and_side(still(row), c, end, conditions);
    return vertex_and_side(c, end, conditions);
  }

  using Vector_of_time = Moving_vector<D, N>;

  /// p(s) - x.
  Vector_of_time from_p(const Point<D>& x) const {
    Vector_of_time result = between<D, N>(motion_.p, x);
    for (std::size_t k = 0; k < D; ++k) result.rate[k] = N(N(motion_.target[k]) - N(motion_.p[k]));
    return result;
  }
  const Point<D>& still(const Near_row& row) const {
    return row.of_motion.corners[1] == 1 ? *motion_.q : *motion_.third;
  }

  Near_equation<N> vertex_and_vertex(const Point<D>& c) const {
    const Vector_of_time u = from_p(c);
    return {scalar_product<D>(u, u) - Polynomial<N>{N(0), N(0), square_of_radius_}};
  }

  /// The foot of the vertex is in the edge, which has a length.
  Near_equation<N> edge_and_vertex(const Point<D>& q, const Point<D>& c, bool conditions) const {
    const Vector_of_time d = from_p(q), g = between<D, N>(c, q);
    const Polynomial<N> dd = scalar_product<D>(d, d), gd = scalar_product<D>(g, d);
    const Polynomial<N> p = scalar_product<D>(g, g).constant * dd - squared(gd) - square_of_radius_ * dd;
    if (!conditions) return {p};
    return {p, {gd, dd - gd}, {dd}};
  }

  /// The foot of the vertex is on the inner side of all edges of the face, seen along its normal.
  Near_equation<N> face_and_vertex(const Point<D>& c, bool conditions) const {
    const Vector_of_time to_p = from_p(*motion_.q), ridge = between<D, N>(*motion_.third, *motion_.q);
    const Vector_of_time n = vector_product(ridge, to_p), g = between<D, N>(c, *motion_.q);
    const auto along_n = [&](const Vector_of_time& x, const Vector_of_time& y) {
      return scalar_product<D>(vector_product(x, y), n);
    };
    const Polynomial<N> nn = scalar_product<D>(n, n);
    const Polynomial<N> p = squared(scalar_product<D>(g, n)) - square_of_radius_ * nn;
    if (!conditions) return {p};
    return {p,
            {along_n(ridge, g), along_n(from_p(*motion_.third), between<D, N>(c, *motion_.third)),
             along_n(g, to_p)},
            {nn}};
  }

  Near_equation<N> vertex_and_side(const Point<D>& c, const Point<D>& end, bool conditions) const {
    const Vector_of_time e = between<D, N>(end, c), u = from_p(c);
    const Polynomial<N> ee = scalar_product<D>(e, e), ue = scalar_product<D>(u, e);
    const Polynomial<N> p = ee.constant * scalar_product<D>(u, u) - squared(ue) - square_of_radius_ * ee;
    if (!conditions) return {p};
    return {p, {ue, ee - ue}};
  }

  /// The nearest points of both lines, by Cramer's rule, are in the edges, which are not parallel.
  Near_equation<N> edge_and_side(const Point<D>& q, const Point<D>& c, const Point<D>& end,
                                 bool conditions) const {
    const Vector_of_time d = from_p(q), e = between<D, N>(end, c), g = between<D, N>(c, q);
    const Vector_of_time n = vector_product(d, e);
    const Polynomial<N> nn = scalar_product<D>(n, n);
    const Polynomial<N> p = squared(scalar_product<D>(g, n)) - square_of_radius_ * nn;
    if (!conditions) return {p};
    const Polynomial<N> of_edge = scalar_product<D>(vector_product(g, e), n),
                        of_side = scalar_product<D>(vector_product(g, d), n);
    return {p, {of_edge, nn - of_edge, of_side, nn - of_side}, {nn}};
  }

  /// The foot of the vertex is on the inner side of all edges.
  Near_equation<N> vertex_and_facet(bool conditions) const {
    const Vector_of_time n =
        vector_product(between<D, N>(wall_[1], wall_[0]), between<D, N>(wall_[2], wall_[0]));
    Near_equation<N> result{squared(scalar_product<D>(from_p(wall_[0]), n)) -
                            square_of_radius_ * scalar_product<D>(n, n)};
    for (std::size_t k = 0; conditions && k < wall_.size(); ++k) {
      const Point<D>&from = wall_[k], &to = wall_[k + 1 == wall_.size() ? 0 : k + 1];
      result.at_least_0.push_back(
          scalar_product<D>(vector_product(between<D, N>(to, from), from_p(from)), n));
    }
    return result;
  }

  const Thick_motion<D>& motion_;
  std::span<const Point<D>> wall_;
  N square_of_radius_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_ROWS_H
