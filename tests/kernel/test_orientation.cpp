// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/policies.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "kernel/integer_orientation.h"

namespace cellwalk {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// A sign by rationals: shares no arithmetic with the kernel.
int exact_sign(const std::array<Point<3>, 4>& p) {
  Rational m[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) m[i][k] = Rational(p[i + 1][k]) - Rational(p[0][k]);
  const Rational d = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return d.sign();
}

int exact_sign(const std::array<Point<2>, 3>& p) {
  const Rational x(p[0][0]), y(p[0][1]);
  const Rational d =
      (Rational(p[1][0]) - x) * (Rational(p[2][1]) - y) - (Rational(p[2][0]) - x) * (Rational(p[1][1]) - y);
  return d.sign();
}

template <class Kernel>
int sign(Predicate_counts& counts, const std::array<Point<3>, 4>& p) {
  return Kernel::orientation(counts, p[0], p[1], p[2], p[3]);
}
template <class Kernel>
int sign(Predicate_counts& counts, const std::array<Point<2>, 3>& p) {
  return Kernel::orientation(counts, p[0], p[1], p[2]);
}

/// Points nearly (or exactly) dependent: the last one is a rounded combination of the others, moved by a few
/// ulp.
template <std::size_t N>
std::array<Point<N - 1>, N> nearly_dependent(std::mt19937_64& random, double scale) {
  constexpr int D = N - 1;
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  std::array<Point<D>, N> p;
  for (std::size_t i = 0; i + 1 < N; ++i)
    for (double& x : p[i]) x = scale * unit();
  const double s = unit(), t = D == 3 ? unit() : 0;
  for (int k = 0; k < D; ++k) {
    p[D][k] = p[0][k] + s * (p[1][k] - p[0][k]);
    if constexpr (D == 3) p[D][k] += t * (p[2][k] - p[0][k]);
    for (unsigned steps = random() % 4; steps > 0; --steps)
      p[D][k] = std::nextafter(p[D][k], random() & 1 ? INFINITY : -INFINITY);
  }
  return p;
}

template <std::size_t N>
void compare_with_rationals(double scale) {
  std::mt19937_64 random(7);
  Predicate_counts counts, rounded;
  int zeros = 0, wrong = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto p = nearly_dependent<N>(random, scale);
    const int expected = exact_sign(p);
    zeros += expected == 0;
    ASSERT_EQ(sign<Exact>(counts, p), expected) << "case " << i;
    if (i % 10 == 0) {
      ASSERT_EQ(sign<Lazy>(counts, p), expected) << "case " << i;
      ASSERT_EQ(sign<Unfiltered>(counts, p), expected) << "case " << i;
    }
    wrong += sign<Double>(rounded, p) != expected;
  }
  EXPECT_GT(counts.fallbacks, 1000u);  // the filter was in doubt often enough to be tested
  EXPECT_GT(wrong, 100);               // and rounding alone would have failed
}

TEST(Orientation, FollowsTheSignConventionOfCgal) {
  Predicate_counts counts;
  const Point<3> o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(Exact::orientation(counts, o, x, y, z), 1);
  EXPECT_EQ(Exact::orientation(counts, o, y, x, z), -1);
  EXPECT_EQ(Exact::orientation(counts, Point<2>{0, 0}, Point<2>{1, 0}, Point<2>{0, 1}), 1);
  EXPECT_EQ(counts.orientations, 3u);
  EXPECT_EQ(counts.fallbacks, 0u);
}

TEST(Orientation, ToleranceIsOfTheDeterminant) {
  Predicate_counts counts;
  // The determinant is the height times 1/4.
  const auto sign_at = [&counts](auto kernel, double height) {
    return decltype(kernel)::orientation(counts, Point<2>{0, 0}, Point<2>{0.25, 0}, Point<2>{0, height});
  };
  for (const int side : {1, -1}) {
    EXPECT_EQ(sign_at(Tolerant{}, side * 4.1e-9), side);
    EXPECT_EQ(sign_at(Tolerant{}, side * 3.9e-9), 0);
    EXPECT_EQ(sign_at(Scale_free{}, side * 3.9e-9), side);
    EXPECT_EQ(sign_at(Unfiltered{}, side * 3.9e-9), side);
  }
  EXPECT_EQ(counts.orientations, 8u);
}

TEST(Orientation, AToleranceInUlpDoesNotDependOnTheScale) {
  Predicate_counts counts;
  for (const double scale : {0x1p-100, 1.0, 0x1p100})
    for (const int ulps : {0, 30, 34}) {  // the terms are 1 and 1 + ulps * u: their sum times 16 u is 32 u
      const Point<2> q{scale, scale}, r{scale, scale * (1 + ulps * 0x1p-53)};
      EXPECT_EQ(Scale_free::orientation(counts, Point<2>{0, 0}, q, r), ulps == 34) << scale << " " << ulps;
      EXPECT_EQ(Double::orientation(counts, Point<2>{0, 0}, q, r), ulps != 0) << scale << " " << ulps;
    }
}

TEST(Orientation, IsExactNearDependence) {
  compare_with_rationals<3>(1.0);
  compare_with_rationals<4>(1.0);
}

TEST(Orientation, IsExactAtSmallAndLargeScales) {
  for (const double scale : {1e-6, 1e6, 0x1p-100, 0x1p100}) {
    compare_with_rationals<3>(scale);
    compare_with_rationals<4>(scale);
  }
}

template <std::size_t N>
std::optional<int> integer_sign(const std::array<Point<N - 1>, N>& p) {
  return std::apply([](const auto&... points) { return detail::integer_orientation(points...); }, p);
}

/// Points of a lattice in a plane of it, or next to one, at any scale and place.
template <std::size_t N>
void compare_in_lattices() {
  constexpr std::size_t D = N - 1;
  std::mt19937_64 random(11);
  const auto below = [&](int bound) { return static_cast<double>(random() % (2 * bound + 1)) - bound; };
  int zeros = 0;
  for (int i = 0; i < 6'000; ++i) {
    std::array<Point<D>, N> p;
    std::array<double, D> scale;
    for (double& x : scale) x = std::ldexp(1.0, static_cast<int>(below(300)));
    for (auto& point : p)
      for (double& x : point) x = below(1 << (i % 20));
    const double s = below(8), t = D == 3 ? below(8) : 0;
    for (std::size_t k = 0; k < D; ++k) {
      p[D][k] = p[0][k] + s * (p[1][k] - p[0][k]);
      if constexpr (D == 3) p[D][k] += t * (p[2][k] - p[0][k]);
    }
    if (i % 3 == 0) p[D][random() % D] += i % 2 == 0 ? 1 : -1;
    for (auto& point : p)
      for (std::size_t k = 0; k < D; ++k) point[k] *= scale[k];
    const auto found = integer_sign<N>(p);
    // Where it is none, an axis on which all are 0 has no unit, or coordinates are too large.
    const bool are_large = std::ranges::any_of(scale, [](double x) { return x > 0x1p30; });
    if (found || !are_large) {
      ASSERT_EQ(found.value_or(0), exact_sign(p)) << "case " << i;
    }
    zeros += found && *found == 0;
  }
  EXPECT_GT(zeros, 600);
}

TEST(IntegerOrientation, IsExactInLattices) {
  compare_in_lattices<3>();
  compare_in_lattices<4>();
}

/// The largest numbers that it takes, with all signs.
template <std::size_t N>
void compare_at_the_limits() {
  constexpr std::size_t D = N - 1;
  std::mt19937_64 random(12);
  const double values[] = {1 - 0x1p-53, 1 - 0x1p-52, 0.5, 0x1p-59, 0x1p-60, 0};
  int undecided = 0;
  for (int i = 0; i < 10'000; ++i) {
    std::array<Point<D>, N> p;
    for (auto& point : p)
      for (double& x : point) x = values[random() % (i % 2 == 0 ? 2 : 6)] * (random() & 1 ? 1 : -1);
    const auto found = integer_sign<N>(p);
    // An axis on which all are 0 has no unit.
    ASSERT_EQ(found.value_or(0), exact_sign(p)) << "case " << i;
    undecided += !found;
  }
  EXPECT_LT(undecided, 1000);
}

TEST(IntegerOrientation, IsExactAtItsLimits) {
  compare_at_the_limits<3>();
  compare_at_the_limits<4>();
}

TEST(IntegerOrientation, LeavesOpenWhatIsNotWhole) {
  const auto with = [](double x, double y, double z) {
    return integer_sign<4>({{{x, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, y, z}}});
  };
  EXPECT_TRUE(with(0x1p-59, 0, 0));
  EXPECT_FALSE(with(0x1p-60, 0, 0));
  EXPECT_FALSE(with(0, 1 + 0x1p-52, 0x1p-60));
  EXPECT_FALSE(with(0, 0x1p60, 0));
  EXPECT_FALSE(with(0x1p-1000, 0, 0));
  EXPECT_FALSE(with(0, 0x1p900, 0x1p-900));
  EXPECT_FALSE(integer_sign<3>({{{0x1p-950, 0}, {0, 1}, {0x1p-951, 1}}}));
}

TEST(Orientation, IsExactWhereProductsUnderflowOrOverflow) {
  Predicate_counts counts;
  // Products of 1e-160 underflow, the third factor is huge: the sign must not be that of the rounded value.
  const std::array<Point<3>, 4> small{
      {{0, 0, 0}, {1e-160, 2e-160, 1}, {2e-160, 4.0001e-160, 2}, {0, 0, 1e200}}};
  EXPECT_EQ(sign<Exact>(counts, small), exact_sign(small));
  const std::array<Point<3>, 4> large{{{0, 0, 0}, {1e200, 1, 0}, {1, 1e200, 0}, {0, 0, 1e200}}};
  EXPECT_EQ(sign<Exact>(counts, large), exact_sign(large));
  const std::array<Point<3>, 4> flat{{{0, 0, 0}, {5e-324, 0, 0}, {0, 5e-324, 0}, {0, 0, 5e-324}}};
  EXPECT_EQ(sign<Exact>(counts, flat), 1);
  EXPECT_GE(counts.fallbacks, 2u);
}

}  // namespace
}  // namespace cellwalk
