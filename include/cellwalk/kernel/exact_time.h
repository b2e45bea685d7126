// SPDX-License-Identifier: LGPL-3.0-or-later
// Times of impact: exact fractions, compared exactly, and rounded only for reports.
#ifndef CELLWALK_KERNEL_EXACT_TIME_H
#define CELLWALK_KERNEL_EXACT_TIME_H

#include <cellwalk/kernel/point.h>

#include <compare>
#include <memory>

namespace cellwalk {

struct Exact_fraction;  // <cellwalk/internal/kernel/crossing.h>

/// A parameter of a motion as an exact number. A comparison needs the fractions only if both times round to
/// the same double. Immutable and cheap to copy.
class Exact_time {
 public:
  Exact_time() = default;  ///< 0
  /// Exactly this double.
  /// \pre finite
  explicit Exact_time(double time) : rounded_(time) {}
  /// A fraction and the greatest double not above it; see to_time().
  /// \param rounded the greatest double not above the fraction
  /// \param fraction the exact time
  Exact_time(double rounded, std::shared_ptr<const Exact_fraction> fraction)
      : rounded_(rounded), fraction_(std::move(fraction)) {}

  /// The greatest double that is not later, so that a reported time is never after the contact.
  double rounded() const { return rounded_; }
  /// The fraction, or null if rounded() is exact.
  const std::shared_ptr<const Exact_fraction>& fraction() const { return fraction_; }

  friend std::strong_ordering operator<=>(const Exact_time& s, const Exact_time& t);
  friend bool operator==(const Exact_time& s, const Exact_time& t) { return (s <=> t) == 0; }

 private:
  double rounded_ = 0;
  std::shared_ptr<const Exact_fraction> fraction_;
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_EXACT_TIME_H
