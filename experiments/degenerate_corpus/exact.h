// SPDX-License-Identifier: LGPL-3.0-or-later
// Rational points, and whether two closed simplices meet. Points in the plane have a third coordinate of 0.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EXACT_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EXACT_H

#include <cellwalk/kernel/point.h>

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::corpus {

using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
using Vec = std::array<Rational, 3>;

template <int D>
Point<3> embedded(const Point<D>& p) {
  if constexpr (D == 3)
    return p;
  else
    return {p[0], p[1], 0};
}

template <int D>
Vec exact(const Point<D>& p) {
  const Point<3> q = embedded<D>(p);
  return {Rational(q[0]), Rational(q[1]), Rational(q[2])};
}

/// The point a + t (b - a).
Vec between(const Vec& a, const Vec& b, const Rational& t);

/// True if the closed hull of up to three points meets a closed point, segment or triangle.
/// \pre the points of `feature` are no fewer than its dimension needs: they do not coincide, nor lie on one
///      line
bool meet(std::span<const Vec> hull, std::span<const Vec> feature);

/// p/q, or p where q is 1.
std::string text(const Rational& x);

/// An exact fraction of the oracles.
template <class Fraction>
Rational to_rational(const Fraction& x) {
  return Rational(x.numerator.str()) / Rational(x.denominator.str());
}

/// The nearest double.
double rounded(const Rational& x);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EXACT_H
