// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers of twice the precision of a double, as unevaluated sums of two, with bounds of their errors. The
// bounds of the operations are those that Joldes, Muller and Popescu prove ("Tight and rigorous error bounds
// for basic building blocks of double-word arithmetic", ACM Transactions on Mathematical Software 44(2),
// 2017), in units of u^2 with u = 2^-53. They hold in round-to-nearest while nothing overflows or underflows.
#ifndef CELLWALK_INTERNAL_KERNEL_TWOFOLD_H
#define CELLWALK_INTERNAL_KERNEL_TWOFOLD_H

namespace cellwalk {

/// The sum high + low, where high is this sum rounded to nearest.
struct Twofold {
  double high = 0, low = 0;
};

/// A number and a bound of the absolute error of its value.
struct Bounded_twofold {
  Twofold value;
  double error;
};

namespace detail {

/// u^2, the unit of the bounds.
inline constexpr double twofold_unit = 0x1p-106;

/// a + b, exactly.
/// \pre |a| >= |b|, or a is 0
inline Twofold quick_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b, exactly.
inline Twofold exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// a - b, exactly.
inline Twofold exact_difference(double a, double b) { return exact_sum(a, -b); }

/// a * b, exactly: each factor is cut into halves of 26 bits, whose products are doubles (Dekker, Veltkamp).
inline Twofold exact_product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double product = a * b;
  const double scaled_a = splitter * a, scaled_b = splitter * b;
  const double a_1 = scaled_a - (scaled_a - a), b_1 = scaled_b - (scaled_b - b);
  const double a_2 = a - a_1, b_2 = b - b_1;
  return {product, a_2 * b_2 - (((product - a_1 * b_1) - a_2 * b_1) - a_1 * b_2)};
}

}  // namespace detail

/// Within 3 u^2 / (1 - 4u) of the exact sum, relatively, even if the two nearly cancel.
inline Twofold operator+(const Twofold& x, const Twofold& y) {
  const Twofold high = detail::exact_sum(x.high, y.high), low = detail::exact_sum(x.low, y.low);
  const Twofold sum = detail::quick_sum(high.high, high.low + low.high);
  return detail::quick_sum(sum.high, low.low + sum.low);
}

inline Twofold operator-(const Twofold& x) { return {-x.high, -x.low}; }
inline Twofold operator-(const Twofold& x, const Twofold& y) { return x + -y; }

/// Within 7 u^2 of the exact product, relatively.
inline Twofold operator*(const Twofold& x, const Twofold& y) {
  const Twofold product = detail::exact_product(x.high, y.high);
  return detail::quick_sum(product.high, product.low + (x.high * y.low + x.low * y.high));
}

/// Within 3 u^2 of the exact product, relatively.
inline Twofold operator*(const Twofold& x, double y) {
  const Twofold product = detail::exact_product(x.high, y);
  const Twofold sum = detail::quick_sum(product.high, x.low * y);
  return detail::quick_sum(sum.high, sum.low + product.low);
}

/// Within 16 u^2 of the exact quotient, relatively.
/// \pre y is not 0
inline Twofold operator/(const Twofold& x, const Twofold& y) {
  const double quotient = x.high / y.high;
  const Twofold product = y * quotient;
  const double rest = (x.high - product.high) + (x.low - product.low);
  return detail::quick_sum(quotient, rest / y.high);
}

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_TWOFOLD_H
