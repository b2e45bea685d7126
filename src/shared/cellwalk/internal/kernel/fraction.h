// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact arithmetic with unreduced fractions of ring numbers, for short chains of operations, whose numbers
// stay short. A Rational is reduced after each operation, which costs more. Includes CGAL; users link
// CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_FRACTION_H
#define CELLWALK_INTERNAL_KERNEL_FRACTION_H

#include <cellwalk/internal/kernel/exact_value.h>
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/kernel/exact_time.h>

#include <compare>
#include <utility>

namespace cellwalk {

/// An unreduced quotient of ring numbers. A comparison takes two products; arithmetic adds the lengths of the
/// numbers.
class Fraction {
 public:
  Fraction() : Fraction(0) {}
  Fraction(int value) : numerator_(value), denominator_(1) {}
  explicit Fraction(double value) : numerator_(value), denominator_(1) {}
  /// \throw Error(not_certified) if the denominator is 0: in a certified environment none is
  Fraction(Ring numerator, Ring denominator)
      : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
    const auto sign_of_denominator = CGAL::sign(denominator_);
    if (sign_of_denominator == CGAL::POSITIVE) return;
    if (sign_of_denominator == CGAL::ZERO) refuse_uncertified();
    numerator_ = -numerator_;
    denominator_ = -denominator_;
  }

  const Ring& numerator() const { return numerator_; }
  const Ring& denominator() const { return denominator_; }  ///< positive
  int sign() const { return static_cast<int>(CGAL::sign(numerator_)); }

  friend std::strong_ordering operator<=>(const Fraction& x, const Fraction& y) {
    if (x.sign() != y.sign()) return x.sign() <=> y.sign();
    const Ring left(x.numerator_ * y.denominator_), right(y.numerator_ * x.denominator_);
    return left < right   ? std::strong_ordering::less
           : right < left ? std::strong_ordering::greater
                          : std::strong_ordering::equal;
  }
  friend bool operator==(const Fraction& x, const Fraction& y) { return (x <=> y) == 0; }

  friend Fraction operator*(const Fraction& x, const Fraction& y) {
    return {Ring(x.numerator_ * y.numerator_), Ring(x.denominator_ * y.denominator_)};
  }
  /// The midpoint of two fractions.
  friend Fraction middle(const Fraction& x, const Fraction& y) {
    return {Ring(x.numerator_ * y.denominator_ + y.numerator_ * x.denominator_),
            Ring(x.denominator_ * y.denominator_ * Ring(2))};
  }

 private:
  Ring numerator_, denominator_;
};

Rational to_rational(const Fraction& fraction);

/// \pre the fraction lies in the range of doubles
Exact_time to_time(const Fraction& fraction);

/// \pre the time is a double, or not one of two roots of a polynomial (Exact_root)
Fraction to_fraction(const Exact_time& time);
/// \pre as to_fraction()
Rational to_rational(const Exact_time& time);

/// Rounded towards 0.
double to_double(const Fraction& fraction);

/// A double, and whether it is the number from which it was rounded.
struct Rounded {
  double value;
  bool is_exact;
};

/// The greatest double that is not above a fraction.
Rounded rounded_down(const Fraction& fraction);
/// The nearest double; half way between two, the lower one.
double rounded_to_nearest(const Fraction& fraction);
/// The double nearest to the square root; half way between two, the even one.
/// \pre the fraction is not negative, and its root lies in the range of doubles
double root_to_nearest(const Fraction& square);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_FRACTION_H
