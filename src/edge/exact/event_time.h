// SPDX-License-Identifier: LGPL-3.0-or-later
// Times of events: roots of orientations of a moving point. They are compared by bounds in doubles first, and
// by fractions if these are inconclusive. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_EXACT_EVENT_TIME_H
#define CELLWALK_EDGE_EXACT_EVENT_TIME_H

#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/orientation_value.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace cellwalk::detail {

/// The orientation of p(s) = a + s (b - a) and fixed points, which is affine in s: its signs at 0 and 1, and
/// bounds of its root if these differ.
template <int D>
class Moving_orientation {
 public:
  using Fixed = std::array<Point<D>, static_cast<std::size_t>(D)>;

  /// `sense` is -1 for the opposite function.
  Moving_orientation(const Point<D>& a, const Point<D>& b, const Fixed& fixed, int sense,
                     Predicate_counts& counts)
      : a_(a), b_(b), fixed_(fixed), sense_(sense) {
    const Orientation_value at_a = value(a, counts), at_b = value(b, counts);
    at_0_ = sense * at_a.sign;
    at_1_ = sense * at_b.sign;
    if (at_0_ * at_1_ < 0) root_ = root_bounds(at_a, at_b);
  }

  int at_0() const { return at_0_; }
  int at_1() const { return at_1_; }
  bool has_root() const { return at_0_ * at_1_ < 0; }  ///< in the open interval
  double low() const { return root_.low; }             ///< \pre has_root()
  double high() const { return root_.high; }           ///< \pre has_root()

  /// True if the two functions have the same fixed points, and so are equal up to sign, with equal roots.
  bool has_points_of(const Moving_orientation& other) const {
    return std::is_permutation(fixed_.begin(), fixed_.end(), other.fixed_.begin());
  }
  /// Where the root is.
  Crossing<D> crossing() const { return {a_, b_, fixed_}; }
  /// \pre has_root()
  Fraction root() const { return fraction_of(crossing()); }
  /// The sign at a time.
  int sign_at(const Fraction& s) const {
    const Ring rest = s.denominator() - s.numerator();
    return sense_ * static_cast<int>(CGAL::sign(Ring(exact(a_) * rest + exact(b_) * s.numerator())));
  }

 private:
  // The moving point comes last, so that it occurs in one difference only: a target may be so far away that
  // its difference from a point of the environment loses that point. In 3D this order reverses the sign. All
  // differences are taken from a point of the environment, so that lines parallel to an axis, as the motion
  // may be, stay parallel to it.
  Orientation_value value(const Point<D>& x, Predicate_counts& counts) const {
    if constexpr (D == 2) {
      return orientation_value(counts, fixed_[0], fixed_[1], x);
    } else {
      Orientation_value value = orientation_value(counts, fixed_[1], fixed_[2], fixed_[0], x);
      value.sign = -value.sign;
      return value;
    }
  }
  Ring exact(const Point<D>& x) const {
    if constexpr (D == 2)
      return Exact_value::orientation(fixed_[0], fixed_[1], x);
    else
      return -Exact_value::orientation(fixed_[1], fixed_[2], fixed_[0], x);
  }

  Point<D> a_, b_;
  Fixed fixed_;
  int sense_, at_0_, at_1_;
  Root_bounds root_{};
};

/// A time in [0,1] of the motion from a to b.
template <int D>
class Event_time {
 public:
  Event_time() = default;  ///< 0
  explicit Event_time(double time) : low_(time), high_(time) {}
  explicit Event_time(const Fraction& time) : high_(1), value_(time) {}
  /// \pre the function has a root
  static Event_time root_of(const Moving_orientation<D>& function) {
    Event_time result;
    result.low_ = function.low();
    result.high_ = function.high();
    result.function_ = function;
    return result;
  }

  bool is_start() const { return low_ == 0 && (high_ == 0 || (value_ && value_->sign() == 0)); }
  const Fraction& value() const {
    if (!value_) value_ = function_ ? function_->root() : Fraction(low_);
    return *value_;
  }

  /// For reports, mostly without the value.
  Exact_time exact() const {
    if (function_) return to_time(function_->crossing());
    return value_ ? to_time(*value_) : Exact_time(low_);
  }

  /// True if it certainly is before the root of a function.
  bool is_certainly_before(const Moving_orientation<D>& f) const { return high_ < f.low(); }
  /// True if it is given as the root of a function of the same points, up to sign.
  bool is_root_of(const Moving_orientation<D>& f) const { return function_ && function_->has_points_of(f); }

  /// The sign of a function at this time.
  int sign_of(const Moving_orientation<D>& f) const {
    if (f.at_0() == f.at_1() || is_start()) return f.at_0();
    if (f.has_root()) {
      if (high_ < f.low()) return f.at_0();
      if (f.high() < low_) return f.at_1();
      if (is_root_of(f)) return 0;
    }
    return f.sign_at(value());
  }
  /// The sign just after this time, before 1: that of the value, or, if the value is 0, that of the value at
  /// 1.
  int sign_after(const Moving_orientation<D>& f) const {
    if (f.at_0() == f.at_1() || f.at_1() == 0) return f.at_0();
    if (f.at_0() == 0) return f.at_1();
    const int sign = sign_of(f);
    return sign != 0 ? sign : f.at_1();
  }

  friend bool operator<(const Event_time& s, const Event_time& t) {
    if (s.high_ < t.low_) return true;
    if (t.high_ <= s.low_) return false;
    if (s.function_ && t.function_ && s.function_->has_points_of(*t.function_)) return false;
    return s.value() < t.value();
  }

 private:
  double low_ = 0, high_ = 0;
  std::optional<Moving_orientation<D>> function_;  ///< the function of which it is a root
  mutable std::optional<Fraction> value_;          ///< once computed
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXACT_EVENT_TIME_H
