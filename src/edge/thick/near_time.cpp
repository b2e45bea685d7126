// SPDX-License-Identifier: LGPL-3.0-or-later
// A polynomial for each pair of a feature of the motion and one of the wall, and the conditions for its
// roots.
#include "near_time.h"

#include <cellwalk/internal/kernel/direction_at_distance.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/uncertified.h>

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// The corner that moves.
const Feature moving = vertex_feature(0);

/// The pairs of features of one motion and one wall.
template <int D>
class Near_time_search {
 public:
  Near_time_search(const Thick_motion<D>& motion, std::span<const Point<D>> wall)
      : motion_(motion), wall_(wall) {
    const Ring r(motion.radius);
    square_of_radius_ = Ring(r * r);
    for (const auto& corner : {motion.q, motion.third})
      if (corner) sides_.push_back({from_p(*corner), *corner, sides_.size() + 1});
  }

  Near_time run() {
    if (motion_.third && at_still_side()) return std::move(*first_);
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

  /// An edge from p to a corner that stands still.
  struct Side {
    Moving_vector<D> direction;  ///< p(s) - q
    Point<D> q;
    std::size_t corner;  ///< the number of q, see Near_time::of_motion
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
    take(moving, vertex, scalar_product<D>(u, u) - r2, {});
    for (const auto& [d, q, corner] : sides_) {
      // The vertex and the line of the edge; its foot is in the edge, which has a length.
      const Moving_vector<D> g = between<D>(wall_[i], q);
      const Quadratic dd = scalar_product<D>(d, d), gd = scalar_product<D>(g, d);
      take(edge_feature(0, corner), vertex,
           scalar_product<D>(g, g).constant * dd - squared(gd) - square_of_radius_ * dd,
           {{gd, dd - gd}, {dd}});
    }
    if constexpr (D == 3)
      if (motion_.third) at_face(i);
  }

  /// The vertex and the plane of the face; its foot is on the inner side of all edges, seen along the normal.
  void at_face(std::size_t i) {
    const auto &to_p = sides_[0].direction, ridge = between<3>(*motion_.third, *motion_.q);
    const Moving_vector<3> n = vector_product(ridge, to_p), g = between<3>(wall_[i], *motion_.q);
    const auto along_n = [&](const Moving_vector<3>& x, const Moving_vector<3>& y) {
      return scalar_product<3>(vector_product(x, y), n);
    };
    const Quadratic nn = scalar_product<3>(n, n);
    take(facet_feature(0, 1, 2), {{static_cast<std::uint16_t>(i), 0, 0}, 1},
         squared(scalar_product<3>(g, n)) - square_of_radius_ * nn,
         {{along_n(ridge, g), along_n(sides_[1].direction, between<3>(wall_[i], *motion_.third)),
           along_n(g, to_p)},
          {nn}});
  }

  /// If the side that stands still is at the distance r itself, the face is free until p enters the
  /// half-space behind it.
  bool at_still_side() {
    const std::array<Point<D>, 2> side{*motion_.q, *motion_.third};
    const auto n = direction_at_distance<D>(side, wall_, motion_.radius);
    if (!n) return false;
    Moving_vector<D> normal;
    normal.at_0 = n->direction;
    for (Ring& x : normal.rate) x = Ring(0);
    auto root = Exact_root::of(scalar_product<D>(from_p(side[n->corner]), normal), Exact_root::Which::lower);
    if (!root) refuse_uncertified();
    auto [of_side, of_wall] = nearest_in_doubles<D>(side, wall_).features;
    for (std::size_t i = 0; i < of_side.size; ++i) ++of_side.corners[i];
    first_ = Near_time{std::move(*root), of_side, of_wall};
    return true;
  }

  void at_side(std::size_t i, std::size_t j) {
    const Feature side{{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j), 0}, 2};
    const Moving_vector<D> e = between<D>(wall_[j], wall_[i]), u = from_p(wall_[i]);
    const Quadratic ee = scalar_product<D>(e, e), ue = scalar_product<D>(u, e);
    take(moving, side, ee.constant * scalar_product<D>(u, u) - squared(ue) - square_of_radius_ * ee,
         {{ue, ee - ue}, {}});
    if constexpr (D == 3) {
      // The lines of both edges; their nearest points, by Cramer's rule, are in the edges, which are not
      // parallel.
      for (const auto& [d, q, corner] : sides_) {
        const Moving_vector<3> n = vector_product(d, e), g = between<3>(wall_[i], q);
        const Quadratic nn = scalar_product<3>(n, n), of_edge = scalar_product<3>(vector_product(g, e), n),
                        of_side = scalar_product<3>(vector_product(g, d), n);
        take(edge_feature(0, corner), side, squared(scalar_product<3>(g, n)) - square_of_radius_ * nn,
             {{of_edge, nn - of_edge, of_side, nn - of_side}, {nn}});
      }
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
    take(moving, {{0, 1, 2}, 3},
         squared(scalar_product<3>(from_p(wall_[0]), n)) - square_of_radius_ * scalar_product<3>(n, n),
         inside);
  }

  /// Keeps a root in [0,1] at which the conditions hold, if it is the first.
  void take(const Feature& of_motion, const Feature& of_wall, const Quadratic& polynomial,
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
      const Near_time found{*root, of_motion, of_wall};
      if (!first_ || is_before(found, *first_)) first_ = found;
      return;  // the other root is later
    }
  }

  const Thick_motion<D>& motion_;
  std::span<const Point<D>> wall_;
  Ring square_of_radius_;
  boost::container::static_vector<Side, 2> sides_;
  std::optional<Near_time> first_;
};

}  // namespace

bool is_before(const Near_time& x, const Near_time& y) {
  if (const auto order = x.root <=> y.root; order != 0) return order < 0;
  return std::tie(x.of_motion.size, x.of_wall.size) < std::tie(y.of_motion.size, y.of_wall.size);
}

template <int D>
Near_time find_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall) {
  return Near_time_search<D>(motion, wall).run();
}

/// The end of what is swept is off by rounding, and the distance by no more.
template <int D>
bool is_later(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double time) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double most = 0x1p1000;  // of coordinates whose differences are finite
  boost::container::static_vector<Point<D>, 4> swept{
      motion.p, point_on<D>(motion.p, motion.target, std::nextafter(time, infinity))};
  for (const auto& corner : {motion.q, motion.third})
    if (corner) swept.push_back(*corner);
  double largest = 0;
  for (std::size_t k = 0; k < D; ++k)
    largest = std::max({largest, std::abs(motion.p[k]), std::abs(motion.target[k])});
  const double r = std::nextafter(motion.radius + 0x1p-48 * largest, infinity);
  Feature_pair near;
  Distance_counts uncounted;
  return largest < most && std::isfinite(r) &&
         is_apart<D>({swept.data(), swept.size()}, wall, r, near, uncounted);
}

template bool is_later<2>(const Thick_motion<2>&, std::span<const Point<2>>, double);
template bool is_later<3>(const Thick_motion<3>&, std::span<const Point<3>>, double);

template Near_time find_near_time<2>(const Thick_motion<2>&, std::span<const Point<2>>);
template Near_time find_near_time<3>(const Thick_motion<3>&, std::span<const Point<3>>);

}  // namespace cellwalk::detail
