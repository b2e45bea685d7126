// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernels of the experiment against rational numbers, on points that are nearly or exactly dependent.
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "policies.h"

namespace cellwalk::exact_float {
namespace {

/// The last point is a combination of the others, rounded to `places` binary places and moved by some ulp.
template <std::size_t N>
std::array<Point<N - 1>, N> nearly_dependent(std::mt19937_64& random, int places, int most_ulps) {
  constexpr int D = N - 1;
  const auto number = [&] {
    return std::ldexp(std::nearbyint(std::ldexp(static_cast<double>(random()), places - 64)), -places);
  };
  std::array<Point<D>, N> p;
  for (std::size_t i = 0; i + 1 < N; ++i)
    for (double& x : p[i]) x = number();
  const double s = static_cast<double>(random() % 8) / 8,
               t = D == 3 ? static_cast<double>(random() % 8) / 8 : 0;
  for (int k = 0; k < D; ++k) {
    p[D][k] = p[0][k] + s * (p[1][k] - p[0][k]);
    if constexpr (D == 3) p[D][k] += t * (p[2][k] - p[0][k]);
    for (auto left = random() % static_cast<unsigned>(most_ulps + 1); left > 0; --left)
      p[D][k] = std::nextafter(p[D][k], random() & 1 ? INFINITY : -INFINITY);
  }
  return p;
}

template <class Kernel, class Points>
int sign(Predicate_counts& counts, const Points& points) {
  return std::apply([&](const auto&... p) { return Kernel::orientation(counts, p...); }, points);
}

template <std::size_t N>
void compare() {
  std::mt19937_64 random(7);
  Predicate_counts counts, others;
  int zeros = 0, wrong_doubles = 0, wrong_long = 0, wrong_twofold = 0;
  constexpr int cases = 3000;
  for (int i = 0; i < cases; ++i) {
    // Few places: exact zeros. Many: the differences of coordinates are rounded, too.
    const auto p = nearly_dependent<N>(random, i % 2 == 0 ? 20 : 52, i % 3 == 0 ? 0 : 3);
    const int expected = sign<Unfiltered>(others, p);
    zeros += expected == 0;
    ASSERT_EQ(sign<Adaptive>(counts, p), expected) << "case " << i;
    ASSERT_EQ(sign<Epick>(others, p), expected) << "case " << i;
    wrong_doubles += sign<Cartesian>(others, p) != expected;
    wrong_long += sign<Long_double>(others, p) != expected;
    wrong_twofold += sign<Double_double>(others, p) != expected;
  }
  EXPECT_GT(zeros, cases / 20);
  EXPECT_GT(counts.fallbacks, static_cast<std::uint64_t>(cases / 2)) << "the later stages were needed";
  EXPECT_GT(wrong_doubles, cases / 50) << "rounding alone would have failed";
  EXPECT_LE(wrong_long, wrong_doubles);
  EXPECT_LE(wrong_twofold, wrong_long);
}

TEST(Kernels, AreExactNearDependence) {
  compare<3>();
  compare<4>();
}

/// Differences of coordinates that are not doubles: their errors decide.
TEST(Kernels, AdaptiveSignsCountTheErrorsOfDifferences) {
  Predicate_counts counts;
  const double tiny = 0x1p-60;
  for (const double off : {tiny, 0.0, -tiny}) {
    const Point<2> p{tiny + off, tiny}, q{1, 1}, r{2, 2};
    EXPECT_EQ(sign<Adaptive>(counts, std::tie(p, q, r)), sign<Unfiltered>(counts, std::tie(p, q, r)));
    EXPECT_EQ(sign<Adaptive>(counts, std::tie(p, q, r)) == 0, off == 0);
    const Point<3> a{tiny + off, tiny, 0}, b{1, 1, 0}, c{2, 2, 1}, d{3, 3, 5};
    EXPECT_EQ(sign<Adaptive>(counts, std::tie(a, b, c, d)), sign<Unfiltered>(counts, std::tie(a, b, c, d)));
    EXPECT_EQ(sign<Adaptive>(counts, std::tie(a, b, c, d)) == 0, off == 0);
  }
}

}  // namespace
}  // namespace cellwalk::exact_float
