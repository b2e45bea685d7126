// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact integers for the oracle. Every double is an integer times a power of two, so that after scaling all
// of the oracle's arithmetic is on integers: 128-bit ones where a bound shows that they suffice, else checked
// 512-bit ones, which throw where they would overflow.
#ifndef CELLWALK_TESTS_ORACLE_NUMBER_H
#define CELLWALK_TESTS_ORACLE_NUMBER_H

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace cellwalk::oracle {

__extension__ using Int128 = __int128;  // not of ISO C++
using Wide = boost::multiprecision::checked_int512_t;

/// The type that holds sums of two products of N.
template <class N>
struct Product;
template <>
struct Product<Int128> {
  using type = boost::multiprecision::checked_int256_t;
};
template <>
struct Product<Wide> {
  using type = boost::multiprecision::checked_int1024_t;
};

/// A double as mantissa * 2^exponent with an odd mantissa (0 has exponent 0).
struct Dyadic {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

inline Dyadic to_dyadic(double x) {
  if (!std::isfinite(x)) throw std::invalid_argument("the oracle needs finite coordinates");
  Dyadic r;
  if (x == 0) return r;
  r.mantissa = static_cast<std::int64_t>(std::scalbn(std::frexp(x, &r.exponent), 53));
  r.exponent -= 53;
  while (r.mantissa % 2 == 0) {
    r.mantissa /= 2;
    ++r.exponent;
  }
  return r;
}

/// x * 2^shift as an integer.
/// \pre it is one, and fits
template <class N>
N scaled(double x, int shift) {
  const Dyadic d = to_dyadic(x);
  if (d.mantissa == 0) return N(0);
  return N(d.mantissa) * (N(1) << (d.exponent + shift));
}

template <class N>
int sign(const N& x) {
  return (x > 0) - (x < 0);
}

/// Bits of |x|.
template <class N>
int bit_length(N x) {
  if (x < 0) x = -x;
  int bits = 0;
  for (; x > 0; x >>= 1) ++bits;
  return bits;
}
template <>
inline int bit_length(Wide x) {
  if (x < 0) x = -x;
  return x == 0 ? 0 : static_cast<int>(msb(x)) + 1;
}

template <class N>
N greatest_common_divisor(N a, N b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) {
    N r = a % b;
    a = b;
    b = r;
  }
  return a;
}

/// A parameter of a motion: numerator / denominator, denominator > 0.
template <class N>
struct Fraction {
  N numerator = 0;
  N denominator = 1;
};

/// Sign of a - b.
template <class N>
int compare(const Fraction<N>& a, const Fraction<N>& b) {
  using P = typename Product<N>::type;
  return sign(P(P(a.numerator) * P(b.denominator) - P(b.numerator) * P(a.denominator)));
}

template <>
inline int compare(const Fraction<Int128>& a, const Fraction<Int128>& b) {
  const auto small = [](Int128 x) { return x == static_cast<std::int64_t>(x); };
  if (small(a.numerator) && small(a.denominator) && small(b.numerator) && small(b.denominator))
    return (a.numerator * b.denominator > b.numerator * a.denominator) -
           (a.numerator * b.denominator < b.numerator * a.denominator);
  using P = Product<Int128>::type;
  return sign(P(P(a.numerator) * P(b.denominator) - P(b.numerator) * P(a.denominator)));
}

/// Sign at parameter t of the affine function that is `at_start` at 0 and `at_end` at 1.
template <class N>
int sign_between(const N& at_start, const N& at_end, const Fraction<N>& t) {
  using P = typename Product<N>::type;
  if (t.numerator == 0) return sign(at_start);
  if (t.numerator == t.denominator) return sign(at_end);
  return sign(P(P(N(t.denominator - t.numerator)) * P(at_start) + P(t.numerator) * P(at_end)));
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_NUMBER_H
