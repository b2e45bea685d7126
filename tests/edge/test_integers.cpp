// SPDX-License-Identifier: LGPL-3.0-or-later
// The shortcuts that oracles take on their way to exact signs: leading digits of fractions, and a unit that
// makes integers.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "edge/integer_complex.h"
#include "edge/integer_scale.h"
#include "edge/rational_sweep.h"

namespace cellwalk::test {
namespace {

using oracle::Big;
using oracle::Share;

/// A number other than 0 of up to so many times 64 bits.
Big any(Random& random, std::uint64_t limbs) {
  Big x = 1;
  for (std::uint64_t i = 1 + random.below(limbs); i > 0; --i) x = (x << 64) + random.bits();
  return x >> static_cast<unsigned>(random.below(64));
}

TEST(Integers, SharesAreInOrder) {
  Random random(1);
  int close = 0, apart = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Share s{any(random, 12) * (random.below(2) == 0 ? 1 : -1), any(random, 12)};
    const Big factor = any(random, 2);
    // Equal, off by one unit of a much finer fraction, and off by up to about an error of the estimates.
    Share near{s.numerator * factor, s.denominator * factor};
    near.numerator += static_cast<int>(random.below(3)) - 1;
    if (random.below(2) == 0)
      near.numerator += near.numerator >> static_cast<unsigned>(40 + random.below(15));
    for (const Share& t : {near, Share{any(random, 12), any(random, 12)}, Share{0, 1}}) {
      const Big left = s.numerator * t.denominator, right = t.numerator * s.denominator;
      const int order = left < right ? -1 : left > right ? 1 : 0;
      ASSERT_EQ(oracle::sign(oracle::order(s, t)), order);
      ASSERT_EQ(oracle::sign(oracle::order(t, s)), -order);
      const Big size = abs(left), distance = abs(Big(left - right));
      (distance << 40u < size ? close : apart) += 1;
    }
  }
  EXPECT_GT(close, 10'000);
  EXPECT_GT(apart, 10'000);
}

TEST(Integers, PointsBecomeIntegersWhereTheyFit) {
  const auto exponent_for = [](std::initializer_list<Point<2>> points) {
    Integer_scale scale;
    scale.add<2>(std::vector<Point<2>>(points));
    return scale.exponent();
  };
  EXPECT_EQ(exponent_for({{0, 0}, {3, -8}}), 0);
  EXPECT_EQ(exponent_for({{0.75, 0}, {3, -0.125}}), 3);
  EXPECT_EQ(exponent_for({{0x1.8p-500, 0}, {0x1p500, 0}}), 501);
  EXPECT_EQ(exponent_for({{0x1p-600, 0}, {0x1p600, 0}}), 0);
  EXPECT_EQ(exponent_for({{std::numeric_limits<double>::denorm_min(), 0}}), 1074);
}

TEST(Integers, TheUnitMakesNoDifference) {
  for (const double unit : {1.0, 0x1p-900, 0x1p-40, 0x1p400, 0x1p1000}) {
    const auto at = [unit](double x, double y, double z) { return Point<3>{x * unit, y * unit, z * unit}; };
    const Point<3> a = at(0, 0, 0), b = at(3, 0, 0), q = at(0, 1, 0);
    const std::vector<Point<3>> wall{at(1, -1, -1), at(1, 0.25, -1), at(1, 0.25, 1), at(1, -1, 1)};
    const auto time = first_crossing(a, b, q, wall);
    ASSERT_TRUE(time);
    EXPECT_EQ(*time, 1.0 / 3);
    const std::vector<Point<3>> beside{at(1, -1, -1), at(1, 0, -1), at(1, 0, 1), at(1, -1, 1)};
    EXPECT_FALSE(crosses(a, b, q, beside));
  }
  // Some are so far apart that the unit stays what it is.
  constexpr double far = 0x1p1000, tiny = 0x1p-1000;
  const std::vector<Point<2>> wall{{1, -far}, {1, tiny}};
  EXPECT_EQ(first_crossing({0, 0}, {2, 0}, {0, 1}, wall), 0.5);
  EXPECT_FALSE(crosses({0, 0}, {2, 0}, {0, 1}, std::vector<Point<2>>{{1, -far}, {1, -tiny}}));
}

}  // namespace
}  // namespace cellwalk::test
