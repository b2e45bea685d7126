// SPDX-License-Identifier: LGPL-3.0-or-later
// Roots of quadratic polynomials with ring numbers as coefficients, compared exactly: the times at which
// something comes within a radius of a wall. Theory: docs/radius.md. Includes CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_EXACT_ROOT_H
#define CELLWALK_INTERNAL_KERNEL_EXACT_ROOT_H

#include <cellwalk/internal/kernel/fraction.h>

#include <compare>
#include <optional>
#include <utility>

namespace cellwalk {

/// The polynomial square s^2 + linear s + constant.
struct Quadratic {
  Ring square, linear, constant;

  bool is_zero() const;
  friend Quadratic operator-(const Quadratic& p, const Quadratic& q) {
    return {Ring(p.square - q.square), Ring(p.linear - q.linear), Ring(p.constant - q.constant)};
  }
  friend Quadratic operator*(const Ring& factor, const Quadratic& p) {
    return {Ring(factor * p.square), Ring(factor * p.linear), Ring(factor * p.constant)};
  }
  /// True if the polynomials are equal up to a factor other than 0, or both 0.
  friend bool are_proportional(const Quadratic& p, const Quadratic& q);
};

/// A real root of a polynomial that is not constant.
class Exact_root {
 public:
  enum class Which { lower, upper };

  /// \return none if the polynomial has no real root, or is 0. The root of a linear polynomial, and a double
  ///         one, is both the lower and the upper one.
  static std::optional<Exact_root> of(const Quadratic& polynomial, Which which);
  /// The root of a linear polynomial.
  explicit Exact_root(const Fraction& fraction);

  /// The polynomial, up to a factor that makes its first coefficient positive; instead of one with a double
  /// root, its derivative. It is quadratic if and only if it has two roots.
  const Quadratic& polynomial() const { return polynomial_; }
  /// The sign of another polynomial at this root.
  /// Cost: some products of numbers that are up to twice as long as the coefficients.
  int sign_of(const Quadratic& other) const;
  /// The fraction, if the root is known to be one: its polynomial is linear, or it is a double root.
  std::optional<Fraction> as_fraction() const;

  /// Cost: as sign_of(), twice; some products of two coefficients if the polynomials are proportional.
  friend std::strong_ordering operator<=>(const Exact_root& x, const Exact_root& y);
  friend bool operator==(const Exact_root& x, const Exact_root& y) { return (x <=> y) == 0; }
  /// \pre y is finite
  friend std::strong_ordering operator<=>(const Exact_root& x, double y);
  friend bool operator==(const Exact_root& x, double y) { return (x <=> y) == 0; }

  /// The greatest double that is not above a root.
  /// \pre the root lies in the range of doubles
  /// Cost: two or three comparisons with doubles; up to 130 if the coefficients differ by more than 2^400.
  friend Rounded rounded_down(const Exact_root& root);

 private:
  Exact_root(Quadratic polynomial, int side) : polynomial_(std::move(polynomial)), side_(side) {}

  Quadratic polynomial_;
  int side_ = 0;  ///< -1: the lower one of two roots; 1: the upper one; 0: there is one only
};

/// The time of a root, to be compared with other times exactly.
/// \pre the root lies in the range of doubles
Exact_time to_time(const Exact_root& root);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_EXACT_ROOT_H
