// SPDX-License-Identifier: LGPL-3.0-or-later
// Shewchuk's adaptive orientations from their second stage on. An expansion is a sum of doubles that do not
// overlap, by ascending size; so the last one has its sign.
//
//   second stage  the determinant of the rounded differences of coordinates, exactly
//   third stage   the terms of first order in the rounding errors of these differences are added
//   fourth stage  the determinant of the exact differences. Shewchuk adds what is left of it to the second
//                 stage; here it is computed anew, from factors that are mostly a single double
#include <cellwalk/internal/kernel/twofold.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "policies.h"

namespace cellwalk::exact_float {
namespace {

using detail::exact_difference;
using detail::exact_product;
using detail::exact_sum;
using detail::quick_sum;

constexpr double u = 0x1p-53;
/// Of the sum of the parts of an expansion.
constexpr double sum_error = (3 + 8 * u) * u;

/// At most N parts, none of them 0.
template <std::size_t N>
struct Expansion {
  std::array<double, N> part;
  std::size_t size = 0;

  void add(double x) {
    if (x != 0) part[size++] = x;
  }
  double last() const { return size == 0 ? 0 : part[size - 1]; }
};

/// fast_expansion_sum: the parts of both by size, added in turn.
template <std::size_t M, std::size_t N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<M + N> sum;
  double rest = 0;
  for (std::size_t i = 0, j = 0; i < e.size || j < f.size;) {
    const bool is_first = j == f.size || (i < e.size && std::abs(e.part[i]) <= std::abs(f.part[j]));
    const Twofold both = exact_sum(rest, is_first ? e.part[i++] : f.part[j++]);
    sum.add(both.low);
    rest = both.high;
  }
  sum.add(rest);
  return sum;
}

template <std::size_t N>
Expansion<N> operator-(Expansion<N> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.part[i] = -e.part[i];
  return e;
}

/// scale_expansion.
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& e, double x) {
  Expansion<2 * N> product;
  double rest = 0;
  for (std::size_t i = 0; i < e.size; ++i) {
    const Twofold term = exact_product(e.part[i], x), low = exact_sum(rest, term.low);
    product.add(low.low);
    const Twofold high = quick_sum(term.high, low.high);
    product.add(high.low);
    rest = high.high;
  }
  product.add(rest);
  return product;
}

template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Twofold& x) {
  return e * x.low + e * x.high;
}

Expansion<2> expansion(const Twofold& x) {
  Expansion<2> e;
  e.add(x.low);
  e.add(x.high);
  return e;
}

template <std::size_t N>
double estimate(const Expansion<N>& e) {
  double sum = 0;
  for (std::size_t i = 0; i < e.size; ++i) sum += e.part[i];
  return sum;
}

/// A difference of points, each coordinate rounded and the error beside it.
template <int D>
using Difference = std::array<Twofold, static_cast<std::size_t>(D)>;

template <int D>
Difference<D> difference(const Point<D>& x, const Point<D>& y) {
  Difference<D> d;
  for (std::size_t i = 0; i < D; ++i) d[i] = exact_difference(x[i], y[i]);
  return d;
}

template <class... Differences>
bool are_exact(const Differences&... differences) {
  bool are = true;
  for (const auto* d : {&differences...})
    for (const Twofold& x : *d) are &= x.low == 0;
  return are;
}

/// a[i] b[j] - a[j] b[i] of the rounded coordinates.
template <int D>
Expansion<4> minor(const Difference<D>& a, const Difference<D>& b, std::size_t i, std::size_t j) {
  return expansion(exact_product(a[i].high, b[j].high)) + -expansion(exact_product(a[j].high, b[i].high));
}
/// The same of the exact ones.
template <int D>
Expansion<16> exact_minor(const Difference<D>& a, const Difference<D>& b, std::size_t i, std::size_t j) {
  return expansion(a[i]) * b[j] + -(expansion(a[j]) * b[i]);
}
/// The terms of the exact minor that are of first order in the errors, rounded.
template <int D>
double minor_error(const Difference<D>& a, const Difference<D>& b, std::size_t i, std::size_t j) {
  return (a[i].high * b[j].low + b[j].high * a[i].low) - (a[j].high * b[i].low + b[i].high * a[j].low);
}

}  // namespace

int adaptive_sign(double magnitude, const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  constexpr double second_error = (2 + 12 * u) * u, third_error = (9 + 64 * u) * u * u;
  const Difference<2> a = difference<2>(q, p), b = difference<2>(r, p);
  const Expansion<4> rounded = minor<2>(a, b, 0, 1);
  double value = estimate(rounded);
  if (std::abs(value) >= second_error * magnitude) return detail::sign_of(value);
  if (are_exact(a, b)) return detail::sign_of(rounded.last());
  const double bound = third_error * magnitude + sum_error * std::abs(value);
  value += minor_error<2>(a, b, 0, 1);
  if (std::abs(value) >= bound) return detail::sign_of(value);
  return detail::sign_of(exact_minor<2>(a, b, 0, 1).last());
}

int adaptive_sign(double magnitude, const Point<3>& p, const Point<3>& q, const Point<3>& r,
                  const Point<3>& s) {
  constexpr double second_error = (3 + 28 * u) * u, third_error = (26 + 288 * u) * u * u;
  const Difference<3> a = difference<3>(q, p), b = difference<3>(r, p), c = difference<3>(s, p);
  const Expansion<4> ab = minor<3>(a, b, 0, 1), bc = minor<3>(b, c, 0, 1), ca = minor<3>(c, a, 0, 1);
  const auto rounded = ab * c[2].high + bc * a[2].high + ca * b[2].high;
  double value = estimate(rounded);
  if (std::abs(value) >= second_error * magnitude) return detail::sign_of(value);
  if (are_exact(a, b, c)) return detail::sign_of(rounded.last());
  const double bound = third_error * magnitude + sum_error * std::abs(value);
  value += (c[2].high * minor_error<3>(a, b, 0, 1) + c[2].low * estimate(ab)) +
           (a[2].high * minor_error<3>(b, c, 0, 1) + a[2].low * estimate(bc)) +
           (b[2].high * minor_error<3>(c, a, 0, 1) + b[2].low * estimate(ca));
  if (std::abs(value) >= bound) return detail::sign_of(value);
  const auto exact = exact_minor<3>(a, b, 0, 1) * c[2] + exact_minor<3>(b, c, 0, 1) * a[2] +
                     exact_minor<3>(c, a, 0, 1) * b[2];
  return detail::sign_of(exact.last());
}

}  // namespace cellwalk::exact_float
