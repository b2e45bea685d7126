// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace cellwalk::test {
namespace {

Exact_time fraction(int n, int d) { return to_time(Fraction(Ring(n), Ring(d))); }

TEST(ExactTime, IsRoundedDown) {
  EXPECT_EQ(fraction(1, 2).rounded(), 0.5);
  EXPECT_EQ(fraction(1, 2).fraction(), nullptr) << "a double needs no fraction";
  for (int d = 3; d < 200; d += 2)
    for (int n = 1; n < d; ++n) {
      const Exact_time t = fraction(n, d);
      EXPECT_LE(Rational(t.rounded()) * d, Rational(n));
      EXPECT_GT(Rational(std::nextafter(t.rounded(), 1.0)) * d, Rational(n));
    }
}

TEST(ExactTime, IsComparedExactly) {
  // Fractions of the same double, which only exact arithmetic tells apart.
  const double large = std::ldexp(1.0, 100);
  const Exact_time third = fraction(1, 3),
                   later = to_time(Fraction(Ring(large) + Ring(3), Ring(3) * Ring(large)));
  EXPECT_EQ(third.rounded(), later.rounded());
  EXPECT_LT(third, later);
  EXPECT_GT(later, third);
  EXPECT_EQ(third, fraction(2, 6));
  EXPECT_EQ(to_rational(later), Rational(1) / Rational(3) + Rational(1) / Rational(large));
  EXPECT_LT(Exact_time(third.rounded()), third);
  EXPECT_LT(third, Exact_time(std::nextafter(third.rounded(), 1.0)));
}

TEST(ExactTime, OrdersLikeFractions) {
  Random random(5);
  int equal = 0;
  for (int k = 0; k < 20000; ++k) {
    const int n = static_cast<int>(random.below(8)), d = 1 + static_cast<int>(random.below(7));
    const int m = static_cast<int>(random.below(8)), e = 1 + static_cast<int>(random.below(7));
    EXPECT_EQ(fraction(n, d) <=> fraction(m, e), n * e <=> m * d);
    equal += n * e == m * d;
  }
  EXPECT_GT(equal, 1000);
}

}  // namespace
}  // namespace cellwalk::test
