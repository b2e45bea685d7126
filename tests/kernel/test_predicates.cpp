// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/predicates.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace cellwalk {
namespace {

using Rational = boost::multiprecision::cpp_rational;

TEST(Predicates, FindCollinearPoints) {
  EXPECT_TRUE(are_collinear(Point<3>{0, 0, 0}, Point<3>{1, 2, 3}, Point<3>{-2, -4, -6}));
  EXPECT_TRUE(are_collinear(Point<3>{1, 1, 1}, Point<3>{1, 1, 1}, Point<3>{7, 8, 9}));
  EXPECT_FALSE(are_collinear(Point<3>{0, 0, 0}, Point<3>{1, 0, 0}, Point<3>{2, 0, 5e-324}));
  EXPECT_FALSE(are_collinear(Point<3>{0, 0, 0}, Point<3>{1, 2, 3}, Point<3>{2, 4, std::nextafter(6.0, 7.0)}));
  EXPECT_TRUE(are_collinear(Point<2>{0, 0}, Point<2>{3, 1}, Point<2>{9, 3}));
  EXPECT_FALSE(are_collinear(Point<2>{0, 0}, Point<2>{3, 1}, Point<2>{9, std::nextafter(3.0, 4.0)}));
}

TEST(Predicates, FindPointsOnClosedSegments) {
  const Point<3> u{0, 0, 0}, v{2, 4, 6};
  EXPECT_TRUE(on_segment<3>(u, v, {1, 2, 3}));
  EXPECT_TRUE(on_segment<3>(u, v, u));
  EXPECT_TRUE(on_segment<3>(u, v, v));
  EXPECT_FALSE(on_segment<3>(u, v, {3, 6, 9}));
  EXPECT_FALSE(on_segment<3>(u, v, {1, 2, std::nextafter(3.0, 4.0)}));
  EXPECT_TRUE(on_segment<2>({0, 0}, {0, 4}, {0, 1}));
  EXPECT_FALSE(on_segment<2>({0, 0}, {0, 4}, {0, 5}));
}

TEST(Predicates, FindPointsInConvexPolygonsOfEveryPlane) {
  // A square in each coordinate plane direction and a slanted one; the first corner angle is never straight.
  const std::array<std::array<Point<3>, 4>, 4> squares{{{{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}},
                                                        {{{1, 0, 0}, {1, 2, 0}, {1, 2, 2}, {1, 0, 2}}},
                                                        {{{0, 1, 0}, {2, 1, 0}, {2, 1, 2}, {0, 1, 2}}},
                                                        {{{0, 0, 0}, {2, 0, 2}, {2, 2, 4}, {0, 2, 2}}}}};
  for (const auto& square : squares) {
    const Point<3> centre = 0.5 * (square[0] + square[2]), outside = 2 * square[2] - square[0];
    EXPECT_TRUE(in_convex_polygon(square, centre));
    EXPECT_TRUE(in_convex_polygon(square, square[3]));
    EXPECT_TRUE(in_convex_polygon(square, 0.5 * (square[0] + square[1])));
    EXPECT_FALSE(in_convex_polygon(square, outside));
  }
}

TEST(UnitNormal, HasLengthOneAtEveryScaleAndForThinTriangles) {
  std::mt19937_64 random(12);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  int thin = 0;
  for (int i = 0; i < 4000; ++i) {
    const double scale = std::array{1.0, 1e-320, 1e-160, 1e160, 1e308}[static_cast<std::size_t>(i) % 5];
    Point<3> u{unit(), unit(), unit()}, v{unit(), unit(), unit()}, w{unit(), unit(), unit()};
    if (i % 2) w = point_on<3>(u, v, 0.3);  // on one line but for rounding
    u = scale * u, v = scale * v, w = scale * w;
    std::array<Rational, 3> a, b, n;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = Rational(v[k]) - Rational(u[k]);
      b[k] = Rational(w[k]) - Rational(u[k]);
    }
    Rational largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
      largest = std::max<Rational>(largest, abs(n[k]));
    }
    const Vector<3> found = unit_normal(u, v, w);
    if (largest == 0) {
      EXPECT_EQ(found, Vector<3>{});
      continue;
    }
    thin += i % 2;
    double expected[3], squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      expected[k] = static_cast<double>(Rational(n[k] / largest));
      squares += expected[k] * expected[k];
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k] / std::sqrt(squares), 1e-14) << i;
  }
  EXPECT_GT(thin, 1000);
  EXPECT_EQ(unit_normal({0, 0}, {5e-324, 0}), (Vector<2>{0, 1}));
  EXPECT_EQ(unit_normal({-1e308, 0}, {1e308, 0}), (Vector<2>{0, 1}));
  EXPECT_EQ(unit_normal(Point<2>{1, 2}, {1, 2}), (Vector<2>{0, 0}));
}

TEST(PointOn, IsFiniteWhereTheDifferenceIsNot) {
  EXPECT_EQ(point_on<2>({-1.5e308, 1}, {1.5e308, 3}, 0.5), (Point<2>{0, 2}));
  EXPECT_EQ(point_on<2>({-1.5e308, 1}, {1.5e308, 3}, 1), (Point<2>{1.5e308, 3}));
}

}  // namespace
}  // namespace cellwalk
