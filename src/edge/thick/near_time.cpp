// SPDX-License-Identifier: LGPL-3.0-or-later
// A polynomial for each pair of a feature of the motion and one of the wall, and the conditions for its
// roots.
#include "near_time.h"

#include <cellwalk/internal/kernel/uncertified.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <tuple>

namespace cellwalk::detail {
namespace {

/// A vector that changes evenly with time.
template <int D>
struct Moving_vector {
  std::array<Ring, static_cast<std::size_t>(D)> at_0, rate{};
};

/// x - y for points that stand still.
template <int D>
Moving_vector<D> between(const Point<D>& x, const Point<D>& y) {
  Moving_vector<D> result;
  for (std::size_t k = 0; k < D; ++k) {
    result.at_0[k] = Ring(Ring(x[k]) - Ring(y[k]));
    result.rate[k] = Ring(0);
  }
  return result;
}

template <int D>
Ring ring_product(const std::array<Ring, static_cast<std::size_t>(D)>& x,
                  const std::array<Ring, static_cast<std::size_t>(D)>& y) {
  Ring sum(x[0] * y[0]);
  for (std::size_t k = 1; k < D; ++k) sum = Ring(sum + x[k] * y[k]);
  return sum;
}

template <int D>
Quadratic scalar_product(const Moving_vector<D>& x, const Moving_vector<D>& y) {
  return {ring_product<D>(x.rate, y.rate),
          Ring(ring_product<D>(x.at_0, y.rate) + ring_product<D>(x.rate, y.at_0)),
          ring_product<D>(x.at_0, y.at_0)};
}

/// \pre one of them stands still
Moving_vector<3> vector_product(const Moving_vector<3>& x, const Moving_vector<3>& y) {
  Moving_vector<3> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    result.at_0[k] = Ring(x.at_0[i] * y.at_0[j] - x.at_0[j] * y.at_0[i]);
    result.rate[k] = Ring(Ring(x.at_0[i] * y.rate[j] - x.at_0[j] * y.rate[i]) +
                          Ring(x.rate[i] * y.at_0[j] - x.rate[j] * y.at_0[i]));
  }
  return result;
}

/// The square of a polynomial of degree 1.
Quadratic squared(const Quadratic& p) {
  return {Ring(p.linear * p.linear), Ring(Ring(2) * p.linear * p.constant), Ring(p.constant * p.constant)};
}

/// The pairs of features of one motion and one wall.
template <int D>
class Near_time_search {
 public:
  Near_time_search(const Thick_motion<D>& motion, std::span<const Point<D>> wall)
      : motion_(motion), wall_(wall) {
    const Ring r(motion.radius);
    square_of_radius_ = Ring(r * r);
    if (motion.q) edge_ = from_p(*motion.q);
  }

  Near_time run() {
    for (std::size_t i = 0; i < wall_.size(); ++i) at_vertex(i);
    if (wall_.size() == 2) at_side(0, 1);
    if (wall_.size() > 2)
      for (std::size_t i = 0; i < wall_.size(); ++i) at_side(i, i + 1 == wall_.size() ? 0 : i + 1);
    if constexpr (D == 3) at_facet();
    if (!first_) refuse_uncertified();
    return std::move(*first_);
  }

 private:
  /// Polynomials that must be at least 0 at a root, and those that must be greater.
  struct Conditions {
    boost::container::small_vector<Quadratic, 8> at_least_0, above_0;
  };

  /// p(s) - x.
  Moving_vector<D> from_p(const Point<D>& x) const {
    Moving_vector<D> result = between<D>(motion_.p, x);
    for (std::size_t k = 0; k < D; ++k) result.rate[k] = Ring(Ring(motion_.target[k]) - Ring(motion_.p[k]));
    return result;
  }

  void at_vertex(std::size_t i) {
    const Feature vertex{{static_cast<std::uint16_t>(i), 0, 0}, 1};
    const Moving_vector<D> u = from_p(wall_[i]);
    const Quadratic r2{Ring(0), Ring(0), square_of_radius_};
    take(Body_feature::vertex, vertex, scalar_product<D>(u, u) - r2, {});
    if (!motion_.q) return;
    // The vertex and the line of the edge; its foot is in the edge, which has a length.
    const Moving_vector<D> g = between<D>(wall_[i], *motion_.q);
    const Quadratic dd = scalar_product<D>(edge_, edge_), gd = scalar_product<D>(g, edge_);
    take(Body_feature::edge, vertex,
         scalar_product<D>(g, g).constant * dd - squared(gd) - square_of_radius_ * dd, {{gd, dd - gd}, {dd}});
  }

  void at_side(std::size_t i, std::size_t j) {
    const Feature side{{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j), 0}, 2};
    const Moving_vector<D> e = between<D>(wall_[j], wall_[i]), u = from_p(wall_[i]);
    const Quadratic ee = scalar_product<D>(e, e), ue = scalar_product<D>(u, e);
    take(Body_feature::vertex, side,
         ee.constant * scalar_product<D>(u, u) - squared(ue) - square_of_radius_ * ee, {{ue, ee - ue}, {}});
    if constexpr (D == 3) {
      if (!motion_.q) return;
      // The lines of both edges; their nearest points, by Cramer's rule, are in the edges, which are not
      // parallel.
      const Moving_vector<3> n = vector_product(edge_, e), g = between<3>(wall_[i], *motion_.q);
      const Quadratic nn = scalar_product<3>(n, n), of_edge = scalar_product<3>(vector_product(g, e), n),
                      of_side = scalar_product<3>(vector_product(g, edge_), n);
      take(Body_feature::edge, side, squared(scalar_product<3>(g, n)) - square_of_radius_ * nn,
           {{of_edge, nn - of_edge, of_side, nn - of_side}, {nn}});
    }
  }

  void at_facet() {
    if (wall_.size() < 3) return;
    const Moving_vector<3> n = vector_product(between<3>(wall_[1], wall_[0]), between<3>(wall_[2], wall_[0]));
    Conditions inside;
    for (std::size_t k = 0; k < wall_.size(); ++k) {
      const Point<3>&from = wall_[k], &to = wall_[k + 1 == wall_.size() ? 0 : k + 1];
      inside.at_least_0.push_back(scalar_product<3>(vector_product(between<3>(to, from), from_p(from)), n));
    }
    take(Body_feature::vertex, {{0, 1, 2}, 3},
         squared(scalar_product<3>(from_p(wall_[0]), n)) - square_of_radius_ * scalar_product<3>(n, n),
         inside);
  }

  /// Keeps a root in [0,1] at which the conditions hold, if it is the first.
  void take(Body_feature body, const Feature& of_wall, const Quadratic& polynomial,
            const Conditions& conditions) {
    if (polynomial.is_zero()) return;
    for (const auto which : {Exact_root::Which::lower, Exact_root::Which::upper}) {
      const auto root = Exact_root::of(polynomial, which);
      if (!root) return;
      if (root->sign_of({Ring(0), Ring(1), Ring(0)}) < 0 || root->sign_of({Ring(0), Ring(1), Ring(-1)}) > 0)
        continue;
      const auto is_negative = [&](const Quadratic& c) { return root->sign_of(c) < 0; };
      const auto is_positive = [&](const Quadratic& c) { return root->sign_of(c) > 0; };
      if (std::ranges::any_of(conditions.at_least_0, is_negative) ||
          !std::ranges::all_of(conditions.above_0, is_positive))
        continue;
      const Near_time found{*root, body, of_wall};
      if (!first_ || is_before(found, *first_)) first_ = found;
      return;  // the other root is later
    }
  }

  const Thick_motion<D>& motion_;
  std::span<const Point<D>> wall_;
  Ring square_of_radius_;
  Moving_vector<D> edge_;  ///< p(s) - q
  std::optional<Near_time> first_;
};

}  // namespace

bool is_before(const Near_time& x, const Near_time& y) {
  if (const auto order = x.root <=> y.root; order != 0) return order < 0;
  return std::tie(x.body, x.of_wall.size) < std::tie(y.body, y.of_wall.size);
}

template <int D>
Near_time find_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall) {
  return Near_time_search<D>(motion, wall).run();
}

template Near_time find_near_time<2>(const Thick_motion<2>&, std::span<const Point<2>>);
template Near_time find_near_time<3>(const Thick_motion<3>&, std::span<const Point<3>>);

}  // namespace cellwalk::detail
