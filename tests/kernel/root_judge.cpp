// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/root_judge.h"

#include <algorithm>
#include <utility>

namespace cellwalk::test {
namespace {

using Integer = boost::multiprecision::mpz_int;

/// The most bits behind the point; intervals that touch beyond this are a fault of the judge.
constexpr int most_bits = 1 << 17;

struct Interval {
  Rational_judge low, high;
};

int degree(const Polynomial& p) { return p[2] != 0 ? 2 : p[1] != 0 ? 1 : p[0] != 0 ? 0 : -1; }

/// The greatest common divisor, by Euclid.
Polynomial common_divisor(Polynomial p, Polynomial q) {
  while (degree(q) >= 0) {
    while (degree(p) >= degree(q)) {
      const auto m = static_cast<std::size_t>(degree(p)), n = static_cast<std::size_t>(degree(q));
      const Rational_judge factor = p[m] / q[n];
      for (std::size_t k = 0; k <= n; ++k) p[m - k] -= factor * q[n - k];
    }
    std::swap(p, q);
  }
  return p;
}

/// An interval of width 2^-bits at most, in which the root lies.
Interval interval(const Judged_root& root, int bits) {
  Polynomial p = root.polynomial;
  if (degree(p) == 1) return {-p[0] / p[1], -p[0] / p[1]};
  const Rational_judge half = p[1] / p[2] / 2;
  // root = -half +- sqrt(radicand)
  const Rational_judge radicand = half * half - p[0] / p[2];
  const Integer shifted = Integer(numerator(radicand) << (2 * bits)) / denominator(radicand);
  const Integer below = sqrt(shifted);
  const Rational_judge unit = power_of_two(-bits);
  const bool is_exact = Rational_judge(below * below) * unit * unit == radicand;
  const Rational_judge low = Rational_judge(below) * unit, high = is_exact ? low : Rational_judge(low + unit);
  if (root.side < 0) return {-half - high, -half - low};
  return {-half + low, -half + high};
}

/// True if the root is one of a common divisor of both polynomials.
bool is_root_of(const Judged_root& root, const Polynomial& other) {
  if (degree(other) < 0) return true;
  const Polynomial divisor = common_divisor(root.polynomial, other);
  if (degree(divisor) == 0) return false;
  if (degree(divisor) == 2 || degree(root.polynomial) == 1) return true;
  // The other root is that of the divisor, too, or lies on the other side of the vertex.
  const Rational_judge common = -divisor[0] / divisor[1];
  const Rational_judge from_vertex = common + root.polynomial[1] / root.polynomial[2] / 2;
  return from_vertex.sign() == 0 || from_vertex.sign() == root.side;
}

}  // namespace

Rational_judge power_of_two(int exponent) {
  const Integer power = Integer(1) << std::abs(exponent);
  return exponent < 0 ? Rational_judge(Integer(1), power) : Rational_judge(power);
}

Ring ring(const Rational_judge& dyadic) {
  Integer rest = abs(numerator(dyadic));
  Ring sum(0), weight(1);
  for (; rest != 0; rest >>= 32, weight = weight * Ring(0x1p32))
    sum = sum + weight * Ring(static_cast<double>(static_cast<std::uint32_t>(rest & 0xffffffffu)));
  for (Integer d = denominator(dyadic); d != 1; d >>= 1) sum = sum * Ring(0.5);
  return dyadic < 0 ? Ring(-sum) : sum;
}

Quadratic quadratic(const Polynomial& polynomial) {
  return {ring(polynomial[2]), ring(polynomial[1]), ring(polynomial[0])};
}

Rational_judge value_at(const Polynomial& p, const Rational_judge& x) { return (p[2] * x + p[1]) * x + p[0]; }

Polynomial product_of_factors(const Rational_judge& a, const Rational_judge& b, const Rational_judge& c,
                              const Rational_judge& d) {
  return {b * d, a * d + b * c, a * c};
}

bool has_roots(const Polynomial& p) {
  if (degree(p) < 2) return degree(p) == 1;
  const Rational_judge extremum = value_at(p, -p[1] / p[2] / 2);
  return extremum.sign() * p[2].sign() <= 0;
}

bool has_double_root(const Polynomial& p) { return degree(p) == 2 && value_at(p, -p[1] / p[2] / 2) == 0; }

int judged_sign(const Judged_root& root, const Polynomial& other) {
  if (is_root_of(root, other)) return 0;
  for (int bits = 64; bits <= most_bits; bits *= 2) {
    const auto [low, high] = interval(root, bits);
    // How far the value may be from that at the lower end.
    const Rational_judge size = std::max(abs(low), abs(high));
    const Rational_judge slack = (high - low) * (2 * abs(other[2]) * size + abs(other[1]));
    const Rational_judge value = value_at(other, low);
    if (abs(value) > slack) return value.sign();
  }
  throw "the sign remains open";
}

int judged_order(const Judged_root& x, const Judged_root& y) {
  // A root of the common divisor of both polynomials may be the other root of one.
  if (is_root_of(x, y.polynomial) && is_root_of(y, x.polynomial)) {
    const bool are_proportional = degree(common_divisor(x.polynomial, y.polynomial)) == 2;
    if (!are_proportional || has_double_root(x.polynomial)) return 0;
    return (x.side > y.side) - (x.side < y.side);
  }
  for (int bits = 64; bits <= most_bits; bits *= 2) {
    const Interval of_x = interval(x, bits), of_y = interval(y, bits);
    if (of_x.high < of_y.low) return -1;
    if (of_y.high < of_x.low) return 1;
  }
  throw "the order remains open";
}

Judged_root judged_root(const Rational_judge& x) { return {{-x, 1, 0}, 1}; }

Rational_judge approximation(const Judged_root& root, int bits) {
  const Rational_judge low = interval(root, bits).low * power_of_two(bits);
  return Rational_judge(numerator(low) / denominator(low)) * power_of_two(-bits);
}

}  // namespace cellwalk::test
