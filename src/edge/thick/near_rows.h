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

/// A vector that stands still.
template <int D, class N>
using Still_vector = std::array<N, static_cast<std::size_t>(D)>;

/// A vector that changes evenly with time.
template <int D, class N>
struct Moving_vector {
  Still_vector<D, N> at_0, rate;
};

/// x - y.
template <int D, class N>
Still_vector<D, N> between(const Point<D>& x, const Point<D>& y) {
  Still_vector<D, N> result;
  for (std::size_t k = 0; k < D; ++k) result[k] = N(N(x[k]) - N(y[k]));
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
template <int D, class N>
Polynomial<N> scalar_product(const Moving_vector<D, N>& x, const Still_vector<D, N>& y) {
  return {N(0), product_of(x.rate, y), product_of(x.at_0, y)};
}

template <class N>
Still_vector<3, N> vector_product(const Still_vector<3, N>& x, const Still_vector<3, N>& y) {
  return {N(x[1] * y[2] - x[2] * y[1]), N(x[2] * y[0] - x[0] * y[2]), N(x[0] * y[1] - x[1] * y[0])};
}
template <class N>
Moving_vector<3, N> vector_product(const Moving_vector<3, N>& x, const Still_vector<3, N>& y) {
  return {vector_product(x.at_0, y), vector_product(x.rate, y)};
}
template <class N>
Moving_vector<3, N> vector_product(const Still_vector<3, N>& x, const Moving_vector<3, N>& y) {
  return {vector_product(x, y.at_0), vector_product(x, y.rate)};
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

  using Moving = Moving_vector<D, N>;
  using Still = Still_vector<D, N>;

  /// p(s) - x.
  Moving from_p(const Point<D>& x) const {
    return {between<D, N>(motion_.p, x), between<D, N>(motion_.target, motion_.p)};
  }
  const Point<D>& still(const Near_row& row) const {
    return row.of_motion.corners[1] == 1 ? *motion_.q : *motion_.third;
  }

  Near_equation<N> vertex_and_vertex(const Point<D>& c) const {
    const Moving u = from_p(c);
    return {scalar_product<D>(u, u) - Polynomial<N>{N(0), N(0), square_of_radius_}};
  }

  /// The foot of the vertex is in the edge, which has a length.
  Near_equation<N> edge_and_vertex(const Point<D>& q, const Point<D>& c, bool conditions) const {
    const Moving d = from_p(q);
    const Still g = between<D, N>(c, q);
    const Polynomial<N> dd = scalar_product<D>(d, d), gd = scalar_product<D>(d, g);
    const Polynomial<N> p = N(product_of(g, g) - square_of_radius_) * dd - squared(gd);
    if (!conditions) return {p};
    return {p, {gd, dd - gd}, {dd}};
  }

  /// The foot of the vertex is on the inner side of all edges of the face, seen along its normal.
  Near_equation<N> face_and_vertex(const Point<D>& c, bool conditions) const {
    const Moving to_p = from_p(*motion_.q);
    const Still ridge = between<D, N>(*motion_.third, *motion_.q), g = between<D, N>(c, *motion_.q);
    const Moving n = vector_product(ridge, to_p);
    const Polynomial<N> nn = scalar_product<D>(n, n);
    const Polynomial<N> p = squared(scalar_product<D>(n, g)) - square_of_radius_ * nn;
    if (!conditions) return {p};
    return {p,
            {scalar_product<D>(n, vector_product(ridge, g)),
             scalar_product<D>(vector_product(from_p(*motion_.third), between<D, N>(c, *motion_.third)), n),
             scalar_product<D>(vector_product(g, to_p), n)},
            {nn}};
  }

  Near_equation<N> vertex_and_side(const Point<D>& c, const Point<D>& end, bool conditions) const {
    const Still e = between<D, N>(end, c);
    const Moving u = from_p(c);
    const Polynomial<N> ee{N(0), N(0), product_of(e, e)}, ue = scalar_product<D>(u, e);
    const Polynomial<N> p = ee.constant * scalar_product<D>(u, u) - squared(ue) - square_of_radius_ * ee;
    if (!conditions) return {p};
    return {p, {ue, ee - ue}};
  }

  /// The nearest points of both lines, by Cramer's rule, are in the edges, which are not parallel.
  Near_equation<N> edge_and_side(const Point<D>& q, const Point<D>& c, const Point<D>& end,
                                 bool conditions) const {
    const Moving d = from_p(q);
    const Still e = between<D, N>(end, c), g = between<D, N>(c, q);
    const Moving n = vector_product(d, e);
    const Polynomial<N> nn = scalar_product<D>(n, n);
    const Polynomial<N> p = squared(scalar_product<D>(n, g)) - square_of_radius_ * nn;
    if (!conditions) return {p};
    const Polynomial<N> of_edge = scalar_product<D>(n, vector_product(g, e)),
                        of_side = scalar_product<D>(vector_product(g, d), n);
    return {p, {of_edge, nn - of_edge, of_side, nn - of_side}, {nn}};
  }

  /// The foot of the vertex is on the inner side of all edges.
  Near_equation<N> vertex_and_facet(bool conditions) const {
    const Still n = vector_product(between<D, N>(wall_[1], wall_[0]), between<D, N>(wall_[2], wall_[0]));
    const Polynomial<N> height = scalar_product<D>(from_p(wall_[0]), n);
    Polynomial<N> p = squared(height);
    p.constant = N(p.constant - square_of_radius_ * product_of(n, n));
    Near_equation<N> result{p};
    for (std::size_t k = 0; conditions && k < wall_.size(); ++k) {
      const Point<D>&from = wall_[k], &to = wall_[k + 1 == wall_.size() ? 0 : k + 1];
      result.at_least_0.push_back(
          scalar_product<D>(from_p(from), vector_product(n, between<D, N>(to, from))));
    }
    return result;
  }

  const Thick_motion<D>& motion_;
  std::span<const Point<D>> wall_;
  N square_of_radius_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_ROWS_H
