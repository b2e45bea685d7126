// SPDX-License-Identifier: LGPL-3.0-or-later
// Roots of quadratic polynomials in rational arithmetic of another library: as intervals that shrink, by
// integer square roots, until they decide. Roots are equal only if they are those of a common divisor of
// their polynomials.
#ifndef CELLWALK_TESTS_KERNEL_ROOT_JUDGE_H
#define CELLWALK_TESTS_KERNEL_ROOT_JUDGE_H

#include <cellwalk/internal/kernel/exact_root.h>

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <optional>

namespace cellwalk::test {

using Rational_judge = boost::multiprecision::mpq_rational;
/// Coefficients of 1, s and s^2.
using Polynomial = std::array<Rational_judge, 3>;

Rational_judge power_of_two(int exponent);
/// \pre the denominator is a power of two
Ring ring(const Rational_judge& dyadic);
/// \pre all denominators are powers of two
Quadratic quadratic(const Polynomial& polynomial);

Rational_judge value_at(const Polynomial& p, const Rational_judge& x);
Polynomial product_of_factors(const Rational_judge& a, const Rational_judge& b, const Rational_judge& c,
                              const Rational_judge& d);  ///< (a s + b) (c s + d)

struct Judged_root {
  Polynomial polynomial;
  int side;  ///< -1: the lower root, 1: the upper one; of a single one, either
};

bool has_roots(const Polynomial& p);
bool has_double_root(const Polynomial& p);
int judged_sign(const Judged_root& root, const Polynomial& other);
int judged_order(const Judged_root& x, const Judged_root& y);
/// The polynomial s - x.
Judged_root judged_root(const Rational_judge& x);
/// A fraction with denominator 2^bits within 2^-bits of the root.
Rational_judge approximation(const Judged_root& root, int bits);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_KERNEL_ROOT_JUDGE_H
