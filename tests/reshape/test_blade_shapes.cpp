// SPDX-License-Identifier: LGPL-3.0-or-later
// Which polygons are blades: planar and convex ones, however they are turned and rounded; no others.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "oracle/seed.h"
#include "reshape/grids.h"

namespace cellwalk {
namespace {

using Polygon = std::vector<Point<3>>;

/// A frame that is turned at random, and a place: its points are rounded.
struct Frame {
  explicit Frame(Random& random) {
    const auto direction = [&] {
      Vector<3> v;
      do
        for (double& c : v) c = random.real(-1, 1);
      while (!(length(v) > 0.1 && length(v) <= 1));
      return (1 / length(v)) * v;
    };
    x = direction();
    do {
      y = direction();
      y = y - dot(x, y) * x;
    } while (!(length(y) > 0.1));
    y = (1 / length(y)) * y;
    z = cross(x, y);
    if (random.chance(0.2)) x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    size = std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
    for (double& c : origin)
      c = size * (random.chance(0.5) ? random.real(-1, 1) : std::ldexp(random.real(-1, 1), 20));
  }
  Point<3> operator()(double u, double v, double w = 0) const {
    return origin + (size * u) * x + (size * v) * y + (size * w) * z;
  }
  Vector<3> x{}, y{}, z{};
  Point<3> origin{};
  double size = 1;
};

/// Corners on a circle, in order; some of them with others on the sides between.
Polygon convex(const Frame& at, Random& random, bool with_others) {
  const std::size_t count = 3 + random.below(7);
  std::vector<std::array<double, 2>> corners;
  for (std::size_t k = 0; k < count; ++k) {
    const double angle =
        6.283185307179586 * (static_cast<double>(k) + random.real(0, 0.7)) / static_cast<double>(count);
    corners.push_back({std::cos(angle), std::sin(angle)});
  }
  Polygon polygon;
  for (std::size_t k = 0; k < count; ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % count];
    polygon.push_back(at(a[0], a[1]));
    if (with_others)
      for (std::size_t n = random.below(3); n > 0; --n) {
        const double t = 1 - 0.25 * static_cast<double>(n);
        polygon.push_back(at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])));
      }
  }
  if (random.chance(0.5)) std::reverse(polygon.begin(), polygon.end());
  std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(random.below(polygon.size())),
              polygon.end());
  return polygon;
}

double area(const Blade<3>& blade) {
  double sum = 0;
  for (const auto& [a, b, c] : blade.pieces)
    sum += 0.5 * length(cross(blade.points[b] - blade.points[a], blade.points[c] - blade.points[a]));
  return sum;
}

/// Of a planar polygon.
double area(const Polygon& polygon) {
  Vector<3> sum{};
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum = sum + 0.5 * cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  return length(sum);
}

TEST(BladeShapes, AreConvexPolygonsHoweverTheyAreTurned) {
  for (std::uint64_t number = 0; number < 400; ++number) {
    Random random(oracle::reseeded(number));
    const Frame at(random);
    const Polygon polygon = convex(at, random, number % 2 == 1);
    Blade<3> blade;
    ASSERT_NO_THROW(blade = blade_along<3>(polygon)) << number;
    EXPECT_NEAR(area(blade), area(polygon), 1e-6 * area(polygon)) << number;
    EXPECT_EQ(blade.points, polygon);
    if (number % 2 == 0) {
      EXPECT_EQ(blade.pieces.size(), polygon.size() - 2) << number;
    }
  }
}

/// Expects that no door lets a polygon in.
void expect_none(const Polygon& polygon, const std::string& what, std::uint64_t number) {
  try {
    blade_along<3>(polygon);
    FAIL() << "a blade, number " << number;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Error_code::input);
    EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what() << ", number " << number;
  }
}

TEST(BladeShapes, MustBePlanar) {
  for (std::uint64_t number = 0; number < 200; ++number) {
    Random random(oracle::reseeded(number));
    const Frame at(random);
    Polygon polygon;
    do polygon = convex(at, random, false);
    while (polygon.size() < 4);
    const double off = std::pow(10.0, -random.real(0, 6)) * (random.chance(0.5) ? -1 : 1);
    Point<3>& corner = polygon[random.below(polygon.size())];
    corner = corner + (at.size * off) * at.z;
    expect_none(polygon, "lies off the plane of others: give a planar polygon, or triangles", number);
  }
}

TEST(BladeShapes, MustBeConvex) {
  for (std::uint64_t number = 0; number < 400; ++number) {
    Random random(oracle::reseeded(number));
    const Frame at(random);
    Polygon polygon;
    do polygon = convex(at, random, false);
    while (polygon.size() < 4);
    const std::size_t k = random.below(polygon.size()), next = (k + 1) % polygon.size(),
                      last = (k + polygon.size() - 1) % polygon.size();
    const std::size_t kind = number % 4;
    if (kind == 0)  // a bow tie
      std::swap(polygon[k], polygon[next]);
    if (kind == 1) {  // a notch, down to 1e-6 of the size
      const Point<3> middle = polygon[last] + 0.5 * (polygon[next] - polygon[last]);
      const Vector<3> inwards = middle - polygon[k];
      polygon[k] = middle + (std::pow(10.0, -random.real(0, 6)) * at.size / length(inwards)) * inwards;
    }
    if (kind == 2)  // a spike
      polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(k),
                     {polygon[k], polygon[k] + 2.0 * (polygon[k] - polygon[last])});
    if (kind == 3) {  // back and forth
      Polygon there(polygon.begin(), polygon.begin() + 3);
      there.push_back(there[1]);
      polygon = there;
    }
    expect_none(polygon, "the blade is not convex at corner", number);
  }
}

TEST(BladeShapes, MustWindAroundOnce) {
  for (std::uint64_t number = 0; number < 100; ++number) {
    Random random(oracle::reseeded(number));
    const Frame at(random);
    const std::size_t count = 5 + 2 * random.below(4);
    Polygon star;
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = 2 * 6.283185307179586 * static_cast<double>(k) / static_cast<double>(count);
      star.push_back(at(std::cos(angle), std::sin(angle)));
    }
    expect_none(star, "the blade winds around more than once", number);
  }
}

TEST(BladeShapes, MustHaveAnExtent) {
  for (std::uint64_t number = 0; number < 200; ++number) {
    Random random(oracle::reseeded(number));
    const Frame at(random);
    Polygon line;
    for (std::size_t k = 0; k < 3 + random.below(5); ++k) line.push_back(at(random.real(-1, 1), 0.5));
    expect_none(line, "lie in line", number);
    expect_none({line[0], line[1]}, "a blade has at least 3 points", number);
    Polygon polygon = convex(at, random, false);
    const std::size_t k = random.below(polygon.size());
    const Point<3> corner = polygon[k];
    Polygon twice = polygon;
    twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(k), corner);
    expect_none(twice, "of the blade coincide: give each corner once", number);
    polygon[k][random.below(3)] = std::numeric_limits<double>::quiet_NaN();
    expect_none(polygon, "not finite", number);
  }
}

/// Triangles, and surfaces of them, that are none.
TEST(BladeShapes, PiecesMustBeASurface) {
  const Polygon corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.1, 0.7}};
  auto environment = test::simplex_grid<3>(2);
  const auto refusal = [&](const Blade<3>& blade) {
    const std::uint64_t epoch = environment.snapshot().epoch();
    std::string message;
    try {
      Reshaping<3>(environment, {}).cut(blade);
    } catch (const Error& e) {
      message = e.what();
    }
    EXPECT_EQ(environment.snapshot().epoch(), epoch);
    return message;
  };
  const std::string sides = "pieces of the blade do not agree about its sides";
  EXPECT_EQ(refusal({corners, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}}), "") << "bent, and a surface";
  EXPECT_NE(refusal({corners, {{0, 1, 2}, {0, 3, 2}}}).find(sides), std::string::npos)
      << "one is turned over";
  EXPECT_NE(refusal({corners, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}}).find(sides), std::string::npos) << "three";
  EXPECT_NE(refusal({corners, {{0, 1, 2}, {0, 1, 2}}}).find(sides), std::string::npos) << "twice the same";
  EXPECT_NE(refusal({{{0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}}, {{0, 1, 2}}}).find("no extent"),
            std::string::npos);
  EXPECT_THROW(swept_blade(Polygon{{0, 0, 0}, {0.1, 0.3, 0.7}}, Vector<3>{0.2, 0.6, 1.4}), Error)
      << "along itself";
  EXPECT_THROW(swept_blade(Polygon{{0, 0, 0}, {0, 0, 0}}, Vector<3>{1, 0, 0}), Error);
  EXPECT_THROW(blade_along<2>(std::vector<Point<2>>{{1, 1}, {2, 1}, {2, 1}}), Error);
}

}  // namespace
}  // namespace cellwalk
