// SPDX-License-Identifier: LGPL-3.0-or-later
// What doubles prove of a segment and a triangle, judged by exact signs: in general position, some ulps off a
// degeneracy, in it, and at the limits of the doubles.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "edge/chain/certain_crossing.h"

namespace cellwalk::detail {
namespace {

using Points = std::array<Point<3>, 5>;  // p, q, and a triangle

/// The least of the signs that a crossing has to have, without a filter.
int least_sign(const Points& x) {
  const auto& [p, q, u, v, w] = x;
  return std::min({orientation_rational(p, q, u, v), orientation_rational(p, q, v, w),
                   orientation_rational(p, q, w, u), -orientation_rational(u, v, w, p),
                   orientation_rational(u, v, w, q)});
}

struct Seen {
  int crosses = 0, misses = 0, open = 0, wrong = 0;
};

void judge(const Points& x, Seen& seen) {
  const auto& [p, q, u, v, w] = x;
  const Crossing_proof proof = Certain_crossing(p, q)(u, v, w);
  const int least = least_sign(x);
  seen.crosses += proof == Crossing_proof::crosses;
  seen.misses += proof == Crossing_proof::misses;
  seen.open += proof == Crossing_proof::none;
  seen.wrong +=
      (proof == Crossing_proof::crosses && least <= 0) || (proof == Crossing_proof::misses && least >= 0);
}

Points any(Random& random) {
  Points points;
  for (Point<3>& x : points)
    for (double& c : x) c = random.real(-1, 1);
  return points;
}

/// A segment that ends on the triangle, on the line of one of its edges or at a corner, then some ulps off.
Points near_degenerate(Random& random, int ulps) {
  Points x = any(random);
  for (Point<3>& point : x)
    for (double& c : point) c = std::round(64 * c) / 64;
  auto& [p, q, u, v, w] = x;
  const double s = static_cast<double>(random.below(5)) / 4;
  const double t = random.below(2) == 0 ? 0 : (1 - s) * static_cast<double>(random.below(5)) / 4;
  for (std::size_t k = 0; k < 3; ++k) {
    const double on = u[k] + s * (v[k] - u[k]) + t * (w[k] - u[k]);
    q[k] = random.below(2) == 0 ? on : p[k] + 2 * (on - p[k]);
  }
  for (int i = 0; i < ulps; ++i) {
    double& c = x[random.below(5)][random.below(3)];
    c = std::nextafter(c, random.below(2) == 0 ? 2 : -2);
  }
  return x;
}

TEST(CertainCrossing, IsRightAndSeldomOpenInGeneralPosition) {
  Random random(1);
  Seen seen;
  for (int i = 0; i < 40'000; ++i) judge(any(random), seen);
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_EQ(seen.open, 0);
  EXPECT_GT(seen.crosses, 800);
}

TEST(CertainCrossing, IsRightSomeUlpsOffADegeneracy) {
  for (const int ulps : {0, 1, 2, 8, 64}) {
    Random random(static_cast<std::uint64_t>(2 + ulps));
    Seen seen;
    for (int i = 0; i < 8'000; ++i) judge(near_degenerate(random, ulps), seen);
    EXPECT_EQ(seen.wrong, 0) << ulps;
    EXPECT_GT(seen.open, 200) << ulps;
  }
}

TEST(CertainCrossing, HasNoUnit) {
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    Points x = i % 2 == 0 ? any(random) : near_degenerate(random, i % 5);
    const auto proof = [&] { return Certain_crossing(x[0], x[1])(x[2], x[3], x[4]); };
    const Crossing_proof before = proof();
    for (const int exponent : {-200, 200}) {
      for (Point<3>& point : x)
        for (double& c : point) c = std::ldexp(c, exponent);
      EXPECT_EQ(proof(), before);
      for (Point<3>& point : x)
        for (double& c : point) c = std::ldexp(c, -exponent);
    }
  }
}

TEST(CertainCrossing, LeavesWhatMayUnderflowOrOverflowOpen) {
  Random random(4);
  for (const int exponent : {-1060, -1000, -400, 400, 1000, 1022}) {
    Seen seen;
    for (int i = 0; i < 2'000; ++i) {
      Points x = any(random);
      for (Point<3>& point : x)
        for (double& c : point) c = std::ldexp(c, exponent);
      judge(x, seen);
    }
    EXPECT_EQ(seen.open, 2'000) << exponent;
  }
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(Certain_crossing({-most, 0, 0}, {most, 0, 0})({1, -1, -1}, {1, 1, -1}, {1, 0, 1}),
            Crossing_proof::none);
}

TEST(CertainCrossing, IsRightWhereProductsUnderflow) {
  Random random(6);
  Seen seen;
  for (int i = 0; i < 20'000; ++i) {
    Points x = near_degenerate(random, 1 + i % 3);
    const int exponent = -300 - static_cast<int>(random.below(60));
    for (Point<3>& point : x)
      for (double& c : point) c = std::ldexp(c, exponent);
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong, 0);
}

/// Differences of very different sizes: the bound is that of the greatest.
TEST(CertainCrossing, IsRightFarFromTheOriginAndForFlatTriangles) {
  Random random(5);
  Seen seen;
  for (int i = 0; i < 20'000; ++i) {
    Points x = i % 2 == 0 ? any(random) : near_degenerate(random, 3);
    const double far = std::ldexp(1, static_cast<int>(random.below(40))),
                 flat = std::ldexp(1, -static_cast<int>(random.below(40)));
    for (Point<3>& point : x) point = {point[0] + far, point[1] * flat, point[2]};
    judge(x, seen);
  }
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_GT(seen.crosses, 100);
  EXPECT_GT(seen.open, 500);
}

}  // namespace
}  // namespace cellwalk::detail
