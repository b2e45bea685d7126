// SPDX-License-Identifier: LGPL-3.0-or-later
// The error bounds of times and coordinates, and their exact values where the bounds do not suffice.
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/next_double.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "twofold_orientation.h"

namespace cellwalk {
namespace {

using detail::largest_difference;
using detail::least_difference;
using detail::Twofold_normal;

/// Times below this are left to exact arithmetic, since their low parts might underflow.
constexpr double least_time = 0x1p-400;

/// A coordinate whose error is a larger share of it, since it nearly cancels, is rounded exactly.
constexpr double largest_share_of_point = 0x1p-60;

/// True if a line or plane is one of the points with some value of coordinate k.
template <int D>
bool is_in_coordinate_plane(const Crossing<D>& crossing, std::size_t k) {
  return std::all_of(crossing.plane.begin() + 1, crossing.plane.end(),
                     [&](const Point<D>& x) { return x[k] == crossing.plane[0][k]; });
}

/// The time at which one coordinate of a motion has a value. None if that is out of range.
std::optional<Bounded_twofold> bounded_time_of_coordinate(double from, double to, double value) {
  const Twofold passed = detail::exact_difference(value, from), whole = detail::exact_difference(to, from);
  const auto is_in_range = [](double size) { return size > least_difference && size < largest_difference; };
  if (!is_in_range(std::abs(passed.high)) || !is_in_range(std::abs(whole.high))) return {};
  const Twofold time = passed / whole;
  return Bounded_twofold{time, 32 * detail::twofold_unit * std::abs(time.high)};
}

/// How many times larger than its error a value has to be.
constexpr double least_certainty = 1024;

/// The greatest double that is not above a number, if its error allows one only.
std::optional<double> certain_floor(const Bounded_twofold& x) {
  if (x.value.low > x.error) return x.value.high;
  if (x.value.low < -x.error) return detail::next_below(x.value.high);
  return {};
}

/// A coordinate of the point at a time, and the bound of its error.
std::optional<Bounded_twofold> coordinate_at(double from, double to, const Bounded_twofold& time) {
  const Twofold d = detail::exact_difference(to, from);
  const double size = std::abs(d.high);
  if (!(size > least_difference && size < largest_difference)) return {};
  const Twofold part = time.value * d;
  const Twofold value = Twofold{from, 0} + part;
  return Bounded_twofold{value, 2 * time.error * size + detail::twofold_unit * (8 * std::abs(part.high) +
                                                                                4 * std::abs(value.high))};
}

/// The time v_a / (v_a - v_b).
std::optional<Bounded_twofold> quotient(const Bounded_twofold& at_a, const Bounded_twofold& at_b) {
  if (!(std::abs(at_a.value.high) > least_certainty * at_a.error)) return {};
  const Twofold difference = at_a.value - at_b.value;
  const double size = std::abs(difference.high);
  if (!(size > least_certainty * (at_a.error + at_b.error))) return {};
  const Twofold time = at_a.value / difference;
  if (!(time.high > least_time)) return {};
  // The relative errors of v_a, of the difference and of the quotient; the factor covers their products.
  const double share =
      at_a.error / std::abs(at_a.value.high) + (at_a.error + at_b.error) / size + 32 * detail::twofold_unit;
  return Bounded_twofold{time, (1 + 0x1p-8) * share * std::abs(time.high)};
}

/// The time rounded down, if twice the precision of a double suffices; otherwise with a smaller error of the
/// orientation of a, which a motion needs that starts close to the plane, and at last of both.
/// \param time the bounds known
template <int D>
std::optional<double> certain_time(const Crossing<D>& crossing, const std::optional<Bounded_twofold>& time) {
  if (time)
    if (const auto rounded = certain_floor(*time)) return rounded;
  const auto at_a = detail::sharp_orientation<D>(crossing.plane, crossing.a);
  if (!at_a) return {};
  const auto with = [&](const std::optional<Bounded_twofold>& at_b) -> std::optional<double> {
    const auto sharper = at_b ? quotient(*at_a, *at_b) : std::nullopt;
    return sharper ? certain_floor(*sharper) : std::nullopt;
  };
  const Twofold_normal<D> normal = detail::normal_of(crossing.plane);
  if (const auto rounded = with(detail::orientation<D>(normal, crossing.plane[0], crossing.b)))
    return rounded;
  return with(detail::sharp_orientation<D>(crossing.plane, crossing.b));
}

/// The orientations of both ends of a motion.
template <int D>
std::array<Ring, 2> exact_orientations(const Crossing<D>& crossing) {
  const auto of = [&](const Point<D>& x) {
    if constexpr (D == 2)
      return Exact_value::orientation(crossing.plane[0], crossing.plane[1], x);
    else
      return Exact_value::orientation(crossing.plane[0], crossing.plane[1], crossing.plane[2], x);
  };
  return {of(crossing.a), of(crossing.b)};
}

/// A coordinate of the point at a time.
Fraction exact_coordinate(double from, double to, const Fraction& time) {
  const Ring difference = Ring(to) - Ring(from);
  return {Ring(from) * time.denominator() + time.numerator() * difference, time.denominator()};
}

/// The crossing_time(), given the bounds known.
template <int D>
double rounded_time_of(const Crossing<D>& crossing, const std::optional<Bounded_twofold>& time) {
  if (const auto rounded = certain_time(crossing, time)) return *rounded;
  const auto [at_a, at_b] = exact_orientations(crossing);
  if (at_a == at_b) return 0;
  const Fraction exact(at_a, Ring(at_a - at_b));
  if (exact.sign() <= 0) return 0;
  if (exact >= Fraction(1)) return 1;
  return std::max(rounded_down(exact).value, std::numeric_limits<double>::denorm_min());
}

/// A motion's place at a time.
template <int D>
class Place {
 public:
  explicit Place(const Crossing<D>& crossing)
      : p_(crossing.a),
        target_(crossing.b),
        crossing_(&crossing),
        is_crossing_of_p_(true),
        bounded_(bounded_time(crossing)) {}
  Place(const Point<D>& p, const Point<D>& target, const Exact_time& time)
      : p_(p), target_(target), time_(&time) {
    if (!time.fraction()) {
      bounded_ = {{time.rounded(), 0}, 0};
    } else if ((crossing_ = std::get_if<Crossing<D>>(&time.fraction()->source))) {
      bounded_ = bounded_time(*crossing_);
      is_crossing_of_p_ = crossing_->a == p && crossing_->b == target;
    }
  }

  Point_bounds<D> bounds() const {
    Point_bounds<D> bounds;
    for (int i = 0; i < D; ++i) std::tie(bounds.below[i], bounds.above[i]) = bounds_of(i);
    return bounds;
  }

 private:
  std::pair<double, double> bounds_of(int i) const {
    const auto k = static_cast<std::size_t>(i);
    if (p_[k] == target_[k]) return {p_[k], p_[k]};
    if (is_crossing_of_p_ && is_in_coordinate_plane(*crossing_, k))
      return {crossing_->plane[0][k], crossing_->plane[0][k]};
    if (bounded_)
      if (const auto x = coordinate_at(p_[k], target_[k], *bounded_))
        if (const auto below = certain_floor(*x)) return {*below, detail::next_above(*below)};
    const Rounded below = exact_floor(k);
    return {below.value, below.is_exact ? below.value : detail::next_above(below.value)};
  }
  Rounded exact_floor(std::size_t k) const {
    if (!fraction_) fraction_ = time_ ? to_fraction(*time_) : fraction_of(*crossing_);
    return rounded_down(exact_coordinate(p_[k], target_[k], *fraction_));
  }

  const Point<D>&p_, &target_;
  const Exact_time* time_ = nullptr;
  const Crossing<D>* crossing_ = nullptr;
  bool is_crossing_of_p_ = false;
  std::optional<Bounded_twofold> bounded_;
  mutable std::optional<Fraction> fraction_;  ///< once it is needed
};

}  // namespace

template <int D>
std::optional<Bounded_twofold> bounded_time(const Crossing<D>& crossing) {
  for (std::size_t k = 0; k < D; ++k)
    if (is_in_coordinate_plane(crossing, k))
      return bounded_time_of_coordinate(crossing.a[k], crossing.b[k], crossing.plane[0][k]);
  const Twofold_normal<D> normal = detail::normal_of(crossing.plane);
  if (!normal.is_in_range) return {};
  const auto at_a = detail::orientation<D>(normal, crossing.plane[0], crossing.a);
  const auto at_b = detail::orientation<D>(normal, crossing.plane[0], crossing.b);
  if (!at_a || !at_b) return {};
  return quotient(*at_a, *at_b);
}

template <int D>
Fraction fraction_of(const Crossing<D>& crossing) {
  const auto [at_a, at_b] = exact_orientations(crossing);
  return {at_a, Ring(at_a - at_b)};
}

template <int D>
Exact_time to_time(const Crossing<D>& crossing) {
  const auto with_source = [&](double rounded) {
    return Exact_time(rounded, std::make_shared<const Exact_fraction>(Exact_fraction{crossing}));
  };
  if (const auto rounded = certain_time(crossing, bounded_time(crossing))) return with_source(*rounded);
  const Rounded rounded = rounded_down(fraction_of(crossing));
  return rounded.is_exact ? Exact_time(rounded.value) : with_source(rounded.value);
}

template <int D>
double crossing_time(const Crossing<D>& crossing) {
  return rounded_time_of(crossing, bounded_time(crossing));
}

template <int D>
Timed_point<D> timed_point(const Crossing<D>& crossing) {
  const auto time = bounded_time(crossing);
  Timed_point<D> result{rounded_time_of(crossing, time), crossing.a};
  if (result.time == 0) return result;
  std::optional<Fraction> exact;
  for (std::size_t k = 0; k < D; ++k) {
    const double from = crossing.a[k], to = crossing.b[k];
    if (from == to) continue;
    if (is_in_coordinate_plane(crossing, k)) {
      result.point[k] = crossing.plane[0][k];
    } else if (const auto x = time ? coordinate_at(from, to, *time) : std::nullopt;
               x && x->error < largest_share_of_point * std::abs(x->value.high)) {
      result.point[k] = x->value.high;
    } else {
      if (!exact) exact = result.time == 1 ? Fraction(1) : fraction_of(crossing);
      result.point[k] = rounded_to_nearest(exact_coordinate(from, to, *exact));
    }
  }
  return result;
}

template <int D>
Point_bounds<D> bounds_at(const Point<D>& p, const Point<D>& target, const Exact_time& time) {
  if (time.fraction() && std::holds_alternative<Exact_root>(time.fraction()->source))
    return Place<D>(p, target, Exact_time(time.rounded())).bounds();
  return Place<D>(p, target, time).bounds();
}

template <int D>
Point_bounds<D> bounds_at(const Crossing<D>& crossing) {
  return Place<D>(crossing).bounds();
}

#define CELLWALK_INSTANTIATE(D)                                                               \
  template std::optional<Bounded_twofold> bounded_time<D>(const Crossing<D>&);                \
  template Fraction fraction_of<D>(const Crossing<D>&);                                       \
  template Exact_time to_time<D>(const Crossing<D>&);                                         \
  template double crossing_time<D>(const Crossing<D>&);                                       \
  template Timed_point<D> timed_point<D>(const Crossing<D>&);                                 \
  template Point_bounds<D> bounds_at<D>(const Point<D>&, const Point<D>&, const Exact_time&); \
  template Point_bounds<D> bounds_at<D>(const Crossing<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
