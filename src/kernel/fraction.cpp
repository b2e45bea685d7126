// SPDX-License-Identifier: LGPL-3.0-or-later
// The rounding of fractions downwards and to nearest, and their conversion to rationals.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/greatest_double.h>
#include <cellwalk/internal/kernel/next_double.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace cellwalk {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Beyond these bounds, the double of a number or a quotient may be far off, or not a number.
constexpr double smallest_double = 1e-290, largest_double = 1e+290;

bool is_close(double x) { return std::abs(x) > smallest_double && std::abs(x) < largest_double; }

template <class R>
Rational exported(const R& x) {
  if constexpr (std::is_same_v<R, Rational>) {
    return x;
  } else {
    Rational result;
    x.export_to_mpq_t(detail::gmp_number(result));
    return result;
  }
}

/// A double near a positive fraction.
double near(const Fraction& x) {
  const double numerator = CGAL::to_double(x.numerator()), denominator = CGAL::to_double(x.denominator());
  if (is_close(numerator) && is_close(denominator) && is_close(numerator / denominator))
    return numerator / denominator;
  return CGAL::to_double(to_rational(x));
}

/// The sign of a fraction less a double.
int compare(const Fraction& x, double y) {
  return static_cast<int>(CGAL::sign(Ring(x.numerator() - x.denominator() * Ring(y))));
}

/// The greatest double that is not above a positive fraction.
Rounded positive_rounded_down(const Fraction& x) {
  double value = near(x);
  int above = compare(x, value);
  while (above < 0) {
    value = detail::next_below(value);
    above = compare(x, value);
  }
  while (above > 0) {
    const double next = detail::next_above(value);
    above = compare(x, next);
    if (above < 0) return {value, false};
    value = next;
  }
  return {value, true};
}

}  // namespace

Rational to_rational(const Fraction& fraction) {
  return exported(fraction.numerator()) / exported(fraction.denominator());
}

Rounded rounded_down(const Fraction& fraction) {
  if (fraction.sign() == 0) return {0, true};
  if (fraction.sign() > 0) return positive_rounded_down(fraction);
  const Rounded opposite = positive_rounded_down(Fraction(-fraction.numerator(), fraction.denominator()));
  return {opposite.is_exact ? -opposite.value : detail::next_below(-opposite.value), opposite.is_exact};
}

double rounded_to_nearest(const Fraction& fraction) {
  const Rounded below = rounded_down(fraction);
  if (below.is_exact) return below.value;
  const double above = detail::next_above(below.value);
  const Ring twice_middle = Ring(below.value) + Ring(above);
  const Ring difference = Ring(2) * fraction.numerator() - twice_middle * fraction.denominator();
  return CGAL::sign(difference) == CGAL::POSITIVE ? above : below.value;
}

double root_to_nearest(const Fraction& square) {
  const double guess = std::sqrt(near(square));
  const auto is_at_least = [&](const Ring& x, int times) {  // times^2 square >= x^2
    return CGAL::sign(Ring(Ring(times * times) * square.numerator() - x * x * square.denominator())) !=
           CGAL::NEGATIVE;
  };
  const double below = detail::greatest_double(guess, std::numeric_limits<double>::max(),
                                               [&](double x) { return is_at_least(Ring(x), 1); });
  const double above = detail::next_above(below);
  const Ring twice_middle = Ring(below) + Ring(above);
  if (!is_at_least(twice_middle, 2)) return below;
  const bool is_tie = Ring(4) * square.numerator() == twice_middle * twice_middle * square.denominator();
  return is_tie && (std::bit_cast<std::uint64_t>(below) & 1) == 0 ? below : above;
}

double to_double(const Fraction& fraction) {
  if (fraction.sign() == 0) return 0;
  if (fraction.sign() > 0) return positive_rounded_down(fraction).value;
  return -positive_rounded_down(Fraction(-fraction.numerator(), fraction.denominator())).value;
}

}  // namespace cellwalk
