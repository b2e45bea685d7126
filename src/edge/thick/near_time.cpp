// SPDX-License-Identifier: LGPL-3.0-or-later
// The least root of all rows. Most rows are excluded near an approximate time, where intervals prove that
// they have no root.
#include "near_time.h"

#include <cellwalk/internal/kernel/direction_at_distance.h>
#include <cellwalk/internal/kernel/next_double.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/uncertified.h>

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>
#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "near_rows.h"

namespace cellwalk::detail {

template <int D>
Near_rows rows_of(const Thick_motion<D>& motion, std::size_t wall_corners) {
  Near_rows rows;
  const auto add = [&](const Feature& of_motion, const Feature& of_wall) {
    rows.push_back({of_motion, of_wall});
  };
  const Feature moving = vertex_feature(0);
  const std::size_t still = corner_count(motion) - 1;
  for (std::size_t i = 0; i < wall_corners; ++i) {
    add(moving, vertex_feature(i));
    for (std::size_t q = 1; q <= still; ++q) add(edge_feature(0, q), vertex_feature(i));
    if (still == 2) add(facet_feature(0, 1, 2), vertex_feature(i));
  }
  for (std::size_t i = 0; i < wall_corners && wall_corners > 1; ++i) {
    const std::size_t j = i + 1 == wall_corners ? 0 : i + 1;
    if (j == 0 && wall_corners == 2) break;
    add(moving, edge_feature(i, j));
    for (std::size_t q = 1; D == 3 && q <= still; ++q) add(edge_feature(0, q), edge_feature(i, j));
  }
  if (D == 3 && wall_corners > 2) add(moving, facet_feature(0, 1, 2));
  return rows;
}

namespace {

double value_at(const Polynomial<double>& p, double s) { return p.constant + s * (p.linear + s * p.square); }

/// The least root in [0,1] at which the conditions hold, up to rounding; or infinity.
double root_in_doubles(const Near_equation<double>& equation) {
  constexpr double slack = 0x1p-30, never = std::numeric_limits<double>::infinity();
  const auto& [a, b, c] = equation.polynomial;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= -slack * b * b)) return never;
  const double x = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b)) / 2;
  std::array roots{c / x, x / a};
  if (roots[1] < roots[0]) std::swap(roots[0], roots[1]);
  for (double root : roots) {
    if (!(root >= -slack && root <= 1 + slack)) continue;
    root = std::clamp(root, 0.0, 1.0);
    const auto is_above = [&](const Polynomial<double>& p, double least) {
      return value_at(p, root) >= least * (std::abs(p.square) + std::abs(p.linear) + std::abs(p.constant));
    };
    if (std::ranges::all_of(equation.at_least_0, [&](const auto& p) { return is_above(p, -slack); }) &&
        std::ranges::all_of(equation.above_0, [&](const auto& p) { return is_above(p, slack); }))
      return root;
  }
  return never;
}

using Interval = CGAL::Interval_nt<false>;

/// A row that may have its time between two others.
struct Possible_row {
  Near_row row;
  bool holds;  ///< its conditions do in between
};
using Possible_rows = boost::container::small_vector<Possible_row, 4>;

/// The values of a polynomial in between: around the middle, where it varies least.
Interval values(const Polynomial<Interval>& p, double from, double to) {
  const Interval middle((from + to) / 2), off = Interval(from, to) - middle;
  const Interval at_middle = p.constant + middle * (p.linear + middle * p.square);
  const Interval rate = p.linear + 2 * middle * p.square;
  return at_middle + off * (rate + off * p.square);
}

/// \pre products of six coordinates are in the range of doubles
template <int D>
Possible_rows rows_between(double from, double to, const Near_rows& rows, const Thick_motion<D>& motion,
                           std::span<const Point<D>> wall) {
  const CGAL::Protect_FPU_rounding<true> upwards;
  const Near_equations<D, Interval> equations(motion, wall);
  Possible_rows result;
  for (const Near_row& row : rows) {
    const Interval value = values(equations.polynomial_of(row), from, to);
    if (value.inf() > 0 || value.sup() < 0) continue;
    const Near_equation<Interval> equation = equations.of(row);
    bool holds = true, is_possible = true;
    const auto look_at = [&](const Polynomial<Interval>& condition) {
      const Interval at = values(condition, from, to);
      holds &= at.inf() > 0;
      is_possible &= at.sup() >= 0;
    };
    for (const auto& condition : equation.at_least_0) look_at(condition);
    for (const auto& condition : equation.above_0) look_at(condition);
    if (is_possible) result.push_back({row, holds});
  }
  return result;
}

/// Whether the products of rows are in the range of doubles.
template <int D>
bool are_moderate(const Thick_motion<D>& motion, std::span<const Point<D>> wall) {
  constexpr double most = 0x1p150;
  const auto is_moderate = [](const Point<D>& x) {
    return std::ranges::all_of(x, [](double c) { return std::abs(c) < most; });
  };
  return motion.radius < most && is_moderate(motion.p) && is_moderate(motion.target) &&
         is_moderate(motion.q.value_or(motion.p)) && is_moderate(motion.third.value_or(motion.p)) &&
         std::ranges::all_of(wall, is_moderate);
}

Quadratic to_quadratic(const Polynomial<Ring>& p) { return {p.square, p.linear, p.constant}; }

/// The pairs of features of one motion and one wall.
template <int D>
class Near_time_search {
 public:
  Near_time_search(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double about)
      : motion_(motion),
        wall_(wall),
        about_(about),
        rows_(rows_of(motion, wall.size())),
        equations_(motion, wall) {}

  Near_time run() {
    if (motion_.third && at_still_side()) return std::move(*first_);
    if (!take_near_approximate_time())
      for (const Near_row& row : rows_) take(row, 0, 1, false);
    if (!first_) refuse_uncertified();
    return std::move(*first_);
  }

 private:
  /// The motion is free until just before an approximate time, by its hull. Rows without a root between then
  /// and just after do not matter if another one has its time there.
  bool take_near_approximate_time() {
    constexpr double width = 0x1p-30;
    if (!are_moderate(motion_, wall_) || !(about_ <= 1)) return false;
    const double from = std::max(about_ - width, 0.0), to = std::min(about_ + width, 1.0);
    if (from > 0 && !is_later(motion_, wall_, from)) return false;
    for (const auto& [row, holds] : rows_between(from, to, rows_, motion_, wall_)) take(row, from, to, holds);
    return first_.has_value();
  }

  /// If the side that stands still is at the distance r itself, the face is free until p enters the
  /// half-space behind it.
  bool at_still_side() {
    const std::array<Point<D>, 2> side{*motion_.q, *motion_.third};
    const auto n = direction_at_distance<D>(side, wall_, motion_.radius);
    if (!n) return false;
    const Moving_vector<D, Ring> from_side{between<D, Ring>(motion_.p, side[n->corner]),
                                           between<D, Ring>(motion_.target, motion_.p)};
    auto root =
        Exact_root::of(to_quadratic(scalar_product<D>(from_side, n->direction)), Exact_root::Which::lower);
    if (!root) refuse_uncertified();
    auto [of_side, of_wall] = nearest_in_doubles<D>(side, wall_).features;
    for (std::size_t i = 0; i < of_side.size; ++i) ++of_side.corners[i];
    first_ = Near_time{std::move(*root), of_side, of_wall};
    return true;
  }

  /// Keeps a root between two times at which the conditions hold, if it is the first.
  /// \param holds the conditions do, at all of them
  void take(const Near_row& row, double from, double to, bool holds) {
    const Quadratic polynomial = to_quadratic(equations_.polynomial_of(row));
    if (polynomial.is_zero()) return;
    for (const auto which : {Exact_root::Which::lower, Exact_root::Which::upper}) {
      const auto root = Exact_root::of(polynomial, which);
      if (!root) return;
      if (*root < from || *root > to || !(holds || is_time_of(row, *root))) continue;
      const Near_time found{*root, row.of_motion, row.of_wall};
      if (!first_ || is_before(found, *first_)) first_ = found;
      return;  // the other root is later
    }
  }

  /// Whether the conditions hold at a root.
  bool is_time_of(const Near_row& row, const Exact_root& root) const {
    const Near_equation<Ring> equation = equations_.of(row);
    const auto sign = [&](const Polynomial<Ring>& condition) {
      return root.sign_of(to_quadratic(condition));
    };
    return std::ranges::all_of(equation.at_least_0, [&](const auto& c) { return sign(c) >= 0; }) &&
           std::ranges::all_of(equation.above_0, [&](const auto& c) { return sign(c) > 0; });
  }

  const Thick_motion<D>& motion_;
  std::span<const Point<D>> wall_;
  double about_;
  Near_rows rows_;
  Near_equations<D, Ring> equations_;
  std::optional<Near_time> first_;
};

}  // namespace

bool is_before(const Near_time& x, const Near_time& y) {
  if (const auto order = x.root <=> y.root; order != 0) return order < 0;
  return std::tie(x.of_motion.size, x.of_wall.size) < std::tie(y.of_motion.size, y.of_wall.size);
}

template <int D>
double approximate_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall) {
  const Near_equations<D, double> equations(motion, wall);
  double time = std::numeric_limits<double>::infinity();
  for (const Near_row& row : rows_of(motion, wall.size()))
    time = std::min(time, root_in_doubles(equations.of(row)));
  return time;
}

template <int D>
Near_time find_near_time(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double about) {
  return Near_time_search<D>(motion, wall, about).run();
}

/// The end of what is swept is off by rounding, and the distance by no more.
template <int D>
bool is_later(const Thick_motion<D>& motion, std::span<const Point<D>> wall, double time) {
  constexpr double most = 0x1p1000;  // of coordinates whose differences are finite
  boost::container::static_vector<Point<D>, 4> swept{motion.p,
                                                     point_on<D>(motion.p, motion.target, next_above(time))};
  for (const auto& corner : {motion.q, motion.third})
    if (corner) swept.push_back(*corner);
  double largest = 0;
  for (std::size_t k = 0; k < D; ++k)
    largest = std::max({largest, std::abs(motion.p[k]), std::abs(motion.target[k])});
  const double r = next_above(motion.radius + 0x1p-48 * largest);
  Vector<D> direction{};
  Distance_counts uncounted;
  return largest < most && std::isfinite(r) &&
         is_apart<D>({swept.data(), swept.size()}, wall, r, direction, uncounted);
}

template bool is_later<2>(const Thick_motion<2>&, std::span<const Point<2>>, double);
template bool is_later<3>(const Thick_motion<3>&, std::span<const Point<3>>, double);

template double approximate_near_time<2>(const Thick_motion<2>&, std::span<const Point<2>>);
template double approximate_near_time<3>(const Thick_motion<3>&, std::span<const Point<3>>);

template Near_time find_near_time<2>(const Thick_motion<2>&, std::span<const Point<2>>, double);
template Near_time find_near_time<3>(const Thick_motion<3>&, std::span<const Point<3>>, double);

}  // namespace cellwalk::detail
