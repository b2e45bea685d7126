// SPDX-License-Identifier: LGPL-3.0-or-later
// Bounds of times in numbers of twice the precision of a double. Rounding has to be real here: valgrind, for
// one, ignores the direction.
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/random.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "kernel/twofold_orientation.h"

namespace cellwalk::test {
namespace {

using Judge = boost::multiprecision::cpp_rational;  // of another library

Judge value(const Twofold& x) { return Judge(x.high) + Judge(x.low); }

/// A double with a random exponent, and often with few bits, so that sums cancel and products are exact.
double number(Random& random, int range) {
  double x = random.real(-1, 1);
  if (random.below(3) == 0) x = std::ldexp(std::round(std::ldexp(x, 4)), -4);
  return std::ldexp(x, static_cast<int>(random.below(2 * static_cast<std::uint64_t>(range) + 1)) - range);
}

Twofold twofold(Random& random, int range) {
  const double high = number(random, range);
  return detail::quick_sum(high,
                           std::ldexp(high * random.real(-1, 1), -53 - static_cast<int>(random.below(30))));
}

/// True if a result is within some u^2 of the exact one, relatively.
bool is_within(const Twofold& result, const Judge& exact, int units) {
  return abs(Judge(value(result) - exact)) <= units * Judge(detail::twofold_unit) * abs(exact);
}

TEST(Twofold, OperationsKeepTheirBounds) {
  Random random(1);
  for (int i = 0; i < 50000; ++i) {
    const Twofold x = twofold(random, 60);
    Twofold y = twofold(random, 60);
    if (i % 3 == 0)
      y = {-x.high * (1 + std::ldexp(random.real(-1, 1), -40)), y.low * 0x1p-60};  // nearly cancels
    if (i % 3 == 0) y = detail::exact_sum(y.high, y.low);
    const Judge a = value(x), b = value(y);
    ASSERT_TRUE(is_within(x + y, a + b, 4));
    ASSERT_TRUE(is_within(x - y, a - b, 4));
    ASSERT_TRUE(is_within(x * y, a * b, 7));
    ASSERT_TRUE(is_within(x * y.high, a * Judge(y.high), 3));
    if (y.high != 0) {
      ASSERT_TRUE(is_within(x / y, a / b, 16));
    }
    ASSERT_EQ(value(detail::exact_product(x.high, y.high)), Judge(x.high) * Judge(y.high));
    ASSERT_EQ(value(detail::exact_difference(x.high, y.high)), Judge(x.high) - Judge(y.high));
  }
}

template <int D>
Judge exact_orientation(const std::array<Point<D>, D>& plane, const Point<D>& x) {
  std::array<std::array<Judge, D>, D> m;
  for (std::size_t row = 0; row < D; ++row)
    for (std::size_t k = 0; k < D; ++k)
      m[row][k] = Judge((row + 1 < D ? plane[row + 1] : x)[k]) - Judge(plane[0][k]);
  if constexpr (D == 2)
    return Judge(m[0][0] * m[1][1] - m[0][1] * m[1][0]);
  else
    return Judge(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                 m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                 m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

template <int D>
Judge exact_time(const Crossing<D>& c) {
  const Judge at_a = exact_orientation<D>(c.plane, c.a), at_b = exact_orientation<D>(c.plane, c.b);
  return at_a == at_b ? Judge(-1) : Judge(at_a / (at_a - at_b));
}

/// A crossing whose points are drawn by `coordinate`.
template <int D, class Coordinate>
Crossing<D> drawn(Coordinate coordinate) {
  Crossing<D> c;
  const auto draw = [&] {
    Point<D> x;
    for (double& k : x) k = coordinate();
    return x;
  };
  for (Point<D>& x : c.plane) x = draw();
  c.a = draw();
  c.b = draw();
  return c;
}

struct Tally {
  int crossings = 0, bounded = 0;
};

/// Judges the time of a crossing, where its ends are on different sides, and a place at that time.
template <int D>
void judge(const Crossing<D>& c, Tally& tally) {
  const Judge exact = exact_time(c);
  if (!(exact > 0 && exact < 1)) return;
  ++tally.crossings;
  if (const auto bounded = bounded_time(c)) {
    ++tally.bounded;
    ASSERT_LE(abs(Judge(value(bounded->value) - exact)), Judge(bounded->error));
  }
  const Exact_time time = to_time(c);
  ASSERT_LE(Judge(time.rounded()), exact);
  ASSERT_GT(Judge(std::nextafter(time.rounded(), 2.0)), exact);
  ASSERT_EQ(time.fraction() == nullptr, Judge(time.rounded()) == exact);
  ASSERT_EQ(time, to_time(fraction_of(c)));
  ASSERT_EQ(crossing_time(c), std::max(time.rounded(), std::numeric_limits<double>::denorm_min()));
  const Timed_point<D> met = timed_point(c);
  ASSERT_EQ(met.time, crossing_time(c));
  const Point_bounds<D> place = bounds_at<D>(c.a, c.b, time);
  for (int k = 0; k < D; ++k) {
    const Judge x = Judge(c.a[k]) + exact * (Judge(c.b[k]) - Judge(c.a[k]));
    ASSERT_LE(Judge(place.below[k]), x);
    ASSERT_GE(Judge(place.above[k]), x);
    ASSERT_TRUE(place.above[k] == place.below[k] ||
                place.above[k] == std::nextafter(place.below[k], std::numeric_limits<double>::infinity()));
    ASSERT_EQ(place.above[k] == place.below[k], Judge(place.below[k]) == x);
    ASSERT_TRUE(met.point[k] == place.below[k] || met.point[k] == place.above[k]);
  }
}

template <class Dimension>
class CrossingTime : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CrossingTime, Dimensions);

/// Points in general position, some ulp off the plane, or in it.
template <int D>
Crossing<D> drawn_at_plane(Random& random, int kind) {
  if (kind == 2) {
    // Products of differences have more bits than the numbers tested: they do not cancel by themselves.
    Crossing<D> c = drawn<D>([&] { return std::round(random.real(-0x1p45, 0x1p45)); });
    c.a = c.plane[0];
    for (std::size_t i = 1; i < D; ++i)
      c.a = c.a + std::round(random.real(-8, 8)) * (c.plane[i] - c.plane[0]);
    return c;
  }
  const bool is_close = kind == 1;
  Crossing<D> c = drawn<D>([&] { return number(random, 4); });
  const Judge time = exact_time(c);
  if (!is_close || !(time > 0 && time < 1)) return c;
  const Point_bounds<D> place = bounds_at<D>(c.a, c.b, to_time(c));
  for (int k = 0; k < D; ++k) c.a[k] = random.below(2) == 0 ? place.below[k] : place.above[k];
  return c;
}

TYPED_TEST(CrossingTime, OrientationsAreWithinTheirBounds) {
  constexpr int D = TypeParam::value;
  Random random(8);
  int sharp = 0, sharper = 0, signs = 0;
  for (int i = 0; i < 20000; ++i) {
    const Crossing<D> c = drawn_at_plane<D>(random, i % 3);
    const Judge exact = exact_orientation<D>(c.plane, c.a);
    const detail::Twofold_normal<D> normal = detail::normal_of(c.plane);
    if (!normal.is_in_range) continue;
    const auto plain = detail::orientation<D>(normal, c.plane[0], c.a);
    if (!plain) continue;
    ASSERT_LE(abs(Judge(value(plain->value) - exact)), Judge(plain->error));
    if (const int sign = detail::twofold_sign<D>(c.plane, c.a); sign != 0) {
      ++signs;
      ASSERT_EQ(sign, exact.sign());
    }
    const auto found = detail::sharp_orientation<D>(c.plane, c.a);
    if (!found) continue;
    ++sharp;
    ASSERT_LE(abs(Judge(value(found->value) - exact)), Judge(found->error));
    sharper += exact != 0 && plain->error > 0x1p-60 * std::abs(plain->value.high) &&
               found->error < 0x1p-60 * std::abs(found->value.high);
  }
  EXPECT_GT(sharp, 15000);
  EXPECT_GT(signs, 10000);
  EXPECT_GT(sharper, 100) << "close to the plane, where it is needed";
}

TYPED_TEST(CrossingTime, IsRoundedDownInGeneralPosition) {
  constexpr int D = TypeParam::value;
  Random random(2);
  Tally tally;
  for (int i = 0; i < 8000; ++i) {
    const double scale = std::ldexp(1, static_cast<int>(random.below(240)) - 120);
    judge(drawn<D>([&] { return scale * random.real(-1, 1); }), tally);
  }
  EXPECT_GT(tally.crossings, 1000);
  EXPECT_EQ(tally.bounded, tally.crossings) << "no wall in general position needs more";
}

TYPED_TEST(CrossingTime, IsRoundedDownOnLattices) {
  constexpr int D = TypeParam::value;
  Random random(3);
  Tally tally;
  for (int i = 0; i < 8000; ++i)
    judge(drawn<D>([&] { return static_cast<double>(random.below(7)) / 4; }), tally);
  EXPECT_GT(tally.crossings, 300);
}

TYPED_TEST(CrossingTime, IsRoundedDownInPlanesOfOneCoordinate) {
  constexpr int D = TypeParam::value;
  Random random(7);
  Tally tally;
  for (int i = 0; i < 4000; ++i) {
    const int range = i % 4 == 0 ? 160 : 2;
    Crossing<D> c = drawn<D>([&] { return i % 3 == 0 ? number(random, range) : random.real(-1, 1); });
    const auto k = static_cast<std::size_t>(random.below(D));
    for (Point<D>& x : c.plane) x[k] = c.plane[0][k];
    judge(c, tally);
  }
  EXPECT_GT(tally.crossings, 500);
  EXPECT_GT(tally.bounded, 400);
}

TYPED_TEST(CrossingTime, IsRoundedDownNearTheEndsOfAMotion) {
  constexpr int D = TypeParam::value;
  Random random(4);
  Tally tally;
  for (int i = 0; i < 8000; ++i) {
    Crossing<D> c = drawn<D>([&] { return random.real(-1, 1); });
    // One end is moved to some ulp off the plane.
    const Judge exact = exact_time(c);
    if (!(exact > 0 && exact < 1)) continue;
    const Point_bounds<D> place = bounds_at<D>(c.a, c.b, to_time(c));
    Point<D>& end = random.below(2) == 0 ? c.a : c.b;
    for (int k = 0; k < D; ++k) end[k] = random.below(2) == 0 ? place.below[k] : place.above[k];
    judge(c, tally);
  }
  EXPECT_GT(tally.crossings, 500);
  EXPECT_GT(tally.bounded, 0);
}

TYPED_TEST(CrossingTime, IsRoundedDownWhereRangesAreLeft) {
  constexpr int D = TypeParam::value;
  Random random(5);
  Tally tally;
  for (int i = 0; i < 4000; ++i)
    judge(drawn<D>([&] { return number(random, i % 2 == 0 ? 300 : 160); }), tally);
  EXPECT_GT(tally.crossings, 300);
  EXPECT_GT(tally.crossings, tally.bounded) << "some are left to exact arithmetic";
}

TYPED_TEST(CrossingTime, OfOneMotionAndPlaneIsOneInEveryOrderOfItsPoints) {
  constexpr int D = TypeParam::value;
  Random random(6);
  int crossings = 0;
  for (int i = 0; i < 500; ++i) {
    const Crossing<D> c = drawn<D>([&] { return random.real(-1, 1); });
    const Judge exact = exact_time(c);
    if (!(exact > 0 && exact < 1)) continue;
    ++crossings;
    Crossing<D> other = c, same_plane = c;
    std::reverse(other.plane.begin(), other.plane.end());
    ASSERT_EQ(to_time(c), to_time(other));
    same_plane.plane[0] = same_plane.plane[0] + 2 * (same_plane.plane[1] - same_plane.plane[0]);
    ASSERT_EQ(to_time(c) < to_time(same_plane), exact < exact_time(same_plane));
    ASSERT_EQ(to_time(c) == to_time(same_plane), exact == exact_time(same_plane));
  }
  EXPECT_GT(crossings, 50);
}

TEST(CrossingTimeAtEnds, IsZeroOrOneOnlyIfExactlySo) {
  const std::array<Point<2>, 2> line{{{0, 0}, {1, 0}}};
  EXPECT_EQ(crossing_time<2>({{0.5, 0}, {0.5, -1}, line}), 0);
  EXPECT_EQ(crossing_time<2>({{0.5, 1}, {0.5, 0}, line}), 1);
  EXPECT_EQ(crossing_time<2>({{0.5, 0}, {0.75, 0}, line}), 0) << "the motion lies in the line";
  EXPECT_EQ(crossing_time<2>({{0.5, 1}, {0.5, -1}, line}), 0.5);
  EXPECT_LT(crossing_time<2>({{0.5, 1}, {0.5, -1e-300}, line}), 1);
  EXPECT_GT(crossing_time<2>({{0.5, 5e-324}, {0.5, -1e300}, line}), 0);
}

}  // namespace
}  // namespace cellwalk::test
