// SPDX-License-Identifier: LGPL-3.0-or-later
// Distances of hulls against rational arithmetic: at distances of exactly r, and within an ulp of it.
#include <cellwalk/internal/kernel/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <vector>

#include "kernel/hull_pairs.h"
#include "kernel/rational_distance.h"

namespace cellwalk {
namespace {

using test::Fraction;
using test::Hull_pair;
using test::Placement;

constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();

struct Seen {
  int pairs = 0, decisions = 0, apart = 0, at_r = 0, meeting = 0;
  std::array<int, test::placements> at_r_in{}, apart_in{}, near_in{};
};

std::ostream& operator<<(std::ostream& out, const Seen& seen) {
  out << seen.pairs << " pairs, " << seen.meeting << " meet; " << seen.decisions << " decisions, "
      << seen.apart << " apart, " << seen.at_r << " at exactly r";
  for (std::size_t k = 0; k < test::placements; ++k)
    out << "; " << test::placement_names[k] << ' ' << seen.apart_in[k] << " apart, " << seen.near_in[k]
        << " near, " << seen.at_r_in[k] << " at r";
  return out;
}

template <int D>
std::string text_of(const Hull_pair<D>& pair, double r) {
  std::ostringstream text;
  text.precision(17);
  text << std::hexfloat;
  for (const auto* points : {&pair.a, &pair.b}) {
    text << (points == &pair.a ? "a" : " b");
    for (const Point<D>& x : *points) {
      text << " (";
      for (const double c : x) text << ' ' << c;
      text << " )";
    }
  }
  text << " r " << r;
  return text.str();
}

double next_above(double x) { return std::nextafter(x, most); }
double next_below(double x) { return std::nextafter(x, 0.); }

/// Radii at which errors would show: the distance itself, its neighbours, and others.
std::vector<double> radii_of(const Fraction& square, double unit, Random& random) {
  if (square == 0) return {std::max(least, random.chance(0.3) ? 0 : unit * random.real(0.01, 2)), unit};
  const double root = test::root_rounded_down(square);
  std::vector<double> radii{root, next_above(root)};
  switch (random.below(4)) {
    case 0:
      radii.push_back(next_below(root));
      break;
    case 1:
      radii.push_back(root * (1 + (random.chance(0.5) ? 1 : -1) *
                                      std::ldexp(1, -static_cast<int>(random.below(50)) - 2)));
      break;
    case 2:
      radii.push_back(unit * static_cast<double>(1 + random.below(5)));
      break;
    default:
      radii.push_back(root * random.real(0.2, 3));
  }
  std::erase_if(radii, [](double r) { return !(r > 0 && r <= most); });
  return radii;
}

template <int D>
void expect_decisions(const Hull_pair<D>& pair, Placement placement, Random& random, Distance_counts& counts,
                      Seen& seen) {
  const Fraction square = test::shortest_vector<D>(test::to_hull<D>(pair.a), test::to_hull<D>(pair.b)).square;
  ++seen.pairs;
  seen.meeting += square == 0;
  Vector<D> last{};  // as the tests before have left it
  for (const double r : radii_of(square, pair.unit, random)) {
    const bool expected = test::root_is_at_least(square, r);
    const auto k = static_cast<std::size_t>(placement);
    ++seen.decisions;
    seen.apart += expected;
    ++(expected ? seen.apart_in : seen.near_in)[k];
    if (Fraction(r) * Fraction(r) == square) {
      ++seen.at_r;
      ++seen.at_r_in[k];
    }
    Vector<D> none{}, wrong;
    for (double& x : wrong) x = pair.unit * random.real(-1, 1);
    for (Vector<D>* hint : {&none, &last, &wrong}) {
      const bool is_apart = detail::is_apart<D>(pair.a, pair.b, r, *hint, counts);
      ASSERT_EQ(is_apart, expected) << "hint "
                                    << (hint == &none   ? "none"
                                        : hint == &last ? "last"
                                                        : "any")
                                    << ' ' << text_of(pair, r);
    }
    ASSERT_EQ(detail::is_apart<D>(pair.a, pair.b, r, none, counts), expected) << "again " << text_of(pair, r);
  }
}

template <int D>
void expect_rounded_distance(const Hull_pair<D>& pair) {
  const Fraction square = test::shortest_vector<D>(test::to_hull<D>(pair.a), test::to_hull<D>(pair.b)).square;
  ASSERT_EQ(detail::distance_rounded_down<D>(pair.a, pair.b), test::root_rounded_down(square))
      << text_of(pair, 0);
}

template <int D>
void expect_nearest_points(const Hull_pair<D>& pair) {
  const auto shortest = test::shortest_vector<D>(test::to_hull<D>(pair.a), test::to_hull<D>(pair.b));
  if (shortest.square == 0) return;
  const detail::Nearest<D> nearest = detail::nearest_in_doubles<D>(pair.a, pair.b);
  double size = 0;
  for (const auto* points : {&pair.a, &pair.b})
    for (const Point<D>& x : *points) size = std::max(size, length((1 / pair.unit) * x));
  // The shortest vector is unique, the points are not.
  for (std::size_t k = 0; k < D; ++k) {
    const double expected = static_cast<double>(Fraction(shortest.vector[k] / Fraction(pair.unit)));
    ASSERT_NEAR((nearest.on_b[k] - nearest.on_a[k]) / pair.unit, expected, 1e-10 * size) << text_of(pair, 0);
  }
  ASSERT_GE(nearest.features.a.size, 1);
  ASSERT_GE(nearest.features.b.size, 1);
  ASSERT_LE(nearest.features.a.size + nearest.features.b.size, D + 1);
}

template <int D>
void compare_pairs(int pairs_each) {
  test::Pair_maker<D> maker(D == 2 ? 11 : 12);
  Distance_counts counts;
  Seen seen;
  for (int round = 0; round < pairs_each; ++round)
    for (std::size_t k = 0; k < test::placements; ++k) {
      const auto placement = static_cast<Placement>(k);
      const Hull_pair<D> pair = maker.make(placement);
      expect_decisions<D>(pair, placement, maker.random(), counts, seen);
      if (round % 10 == 0) expect_rounded_distance<D>(pair);
      if (round % 4 == 0 && placement < Placement::huge) expect_nearest_points<D>(pair);
      if (testing::Test::HasFatalFailure()) return;
    }
  std::cout << D << "D: " << seen << "\nboxes " << counts.boxes << ", planes " << counts.planes << ", gjk "
            << counts.gjk << ", near " << counts.near << ", ring pair " << counts.ring_pair << ", ring list "
            << counts.ring_list << '\n';
  EXPECT_GT(seen.at_r, seen.decisions / 40);
  EXPECT_GT(seen.apart, seen.decisions / 4);
  EXPECT_LT(seen.apart, 3 * seen.decisions / 4);
  EXPECT_GT(seen.meeting, seen.pairs / 50);
  for (std::size_t k = 0; k < test::placements; ++k) {
    EXPECT_GT(seen.apart_in[k], pairs_each / 2) << test::placement_names[k];
    EXPECT_GT(seen.near_in[k], pairs_each / 2) << test::placement_names[k];
  }
  for (const Placement k : {Placement::lattice, Placement::turned, Placement::huge, Placement::tiny})
    EXPECT_GT(seen.at_r_in[static_cast<std::size_t>(k)], pairs_each / 10);
  // All stages had to decide.
  for (const std::uint64_t n : {counts.boxes, counts.planes, counts.gjk, counts.near, counts.ring_pair})
    EXPECT_GT(n, static_cast<std::uint64_t>(pairs_each) / 10);
  EXPECT_GT(counts.ring_list, 0u);
}

TEST(Distance, AgreesWithRationalsIn2D) { compare_pairs<2>(3500); }
TEST(Distance, AgreesWithRationalsIn3D) { compare_pairs<3>(2500); }

/// Moves that end, at some double, near a distance of r.
template <int D>
void compare_times(int rounds) {
  test::Pair_maker<D> maker(D == 2 ? 13 : 14);
  Random& random = maker.random();
  int apart = 0, near = 0, at_r = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto placement = static_cast<Placement>(random.below(test::placements));
    const Hull_pair<D> pair = maker.make(placement), other = maker.make(placement);
    const Point<D> from = pair.a[0], target = other.a[0];
    std::vector<Point<D>> still(pair.a.begin() + 1, pair.a.end());
    if (still.size() > 2) still.pop_back();
    double time = std::ldexp(static_cast<double>(random.below(9)), -3);
    if (random.chance(0.5)) time = random.chance(0.1) ? random.real(0, 1e-300) : random.real();
    test::Hull<D> swept = test::to_hull<D>(still);
    swept.push_back(test::to_rational_point(from));
    swept.push_back(test::at_time(from, target, Fraction(time)));
    const Fraction square = test::shortest_vector<D>(swept, test::to_hull<D>(pair.b)).square;
    for (const double r : radii_of(square, pair.unit, random)) {
      const bool expected = test::root_is_at_least(square, r);
      ++(expected ? apart : near);
      at_r += Fraction(r) * Fraction(r) == square;
      const bool is_apart = detail::is_apart_until<D>(from, target, still, time, pair.b, r);
      ASSERT_EQ(is_apart, expected) << "to " << text_of<D>({{target}, {}}, time) << "; " << text_of(pair, r);
    }
  }
  std::cout << D << "D: until a time: apart " << apart << ", near " << near << ", at exactly r " << at_r
            << '\n';
  EXPECT_GT(apart, rounds / 2);
  EXPECT_GT(near, rounds / 2);
  EXPECT_GT(at_r, rounds / 40);
}

TEST(Distance, OfWhatIsSweptAgreesWithRationalsIn2D) { compare_times<2>(6000); }
TEST(Distance, OfWhatIsSweptAgreesWithRationalsIn3D) { compare_times<3>(6000); }

// A point (2x, 2x, x) is at 3x from the origin. For this x the square of the double 3x is rounded up.
TEST(Distance, SquaresThatAreNoDoubles) {
  const double x = 1 - 3 * 0x1p-51, r = 3 - 9 * 0x1p-51;
  ASSERT_GT(Fraction(r * r), Fraction(r) * Fraction(r));
  const std::vector<Point<3>> a{{2 * x, 2 * x, x}}, b{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (const int exponent : {0, 1000, -1000}) {
    Hull_pair<3> pair{a, b};
    for (auto* points : {&pair.a, &pair.b})
      for (Point<3>& y : *points) y = std::ldexp(1, exponent) * y;
    const double scaled = std::ldexp(r, exponent);
    Vector<3> near{};
    Distance_counts counts;
    EXPECT_TRUE(detail::is_apart<3>(pair.a, pair.b, scaled, near, counts)) << exponent;
    EXPECT_FALSE(detail::is_apart<3>(pair.a, pair.b, next_above(scaled), near, counts)) << exponent;
    EXPECT_EQ(detail::distance_rounded_down<3>(pair.a, pair.b), scaled) << exponent;
    EXPECT_TRUE(detail::is_apart_until<3>(pair.a[0], pair.a[0], {}, 0.5, pair.b, scaled)) << exponent;
  }
}

// Corners are far from the facet, and the edge goes through it.
TEST(Distance, EdgesThatPierceAreNotApart) {
  const std::vector<Point<3>> edge{{0, 0, -100}, {0, 0, 100}},
      facet{{-90, -80, 0}, {90, -80, 0}, {0, 100, 0}};
  Vector<3> near{};
  Distance_counts counts;
  for (const double r : {least, 1e-300, 1., 50., 1e300}) {
    EXPECT_FALSE(detail::is_apart<3>(edge, facet, r, near, counts)) << r;
    EXPECT_FALSE(detail::is_apart<3>(facet, edge, r, near, counts)) << r;
  }
  EXPECT_EQ(detail::distance_rounded_down<3>(edge, facet), 0);
}

// A judged motion of 437,760: an edge ends 3.7e-10 from a wall of nearly its direction, and begins 5.9e-10
// from it. Products of lengths cancel there.
TEST(Distance, NearestPointsOfEdgesThatAreNearlyParallel) {
  const std::vector<Point<2>> edge{{0x1.970f09ceb24aep-5, 0x1.b1294725a232ep-4},
                                   {0x1.acfda2f449e15p-6, 0x1.a4eb8fce0bc7fp-4}},
      wall{{0x1.cc47cd828f398p-4, 0x1.d1cddab9df05ap-4}, {-0x1.a9c631a06ff95p-7, 0x1.9084b39166a07p-4}};
  const detail::Nearest<2> nearest = detail::nearest_in_doubles<2>(edge, wall);
  EXPECT_EQ(nearest.features.a, detail::vertex_feature(1));
  EXPECT_NEAR(length(nearest.on_b - nearest.on_a), detail::distance_rounded_down<2>(edge, wall), 1e-16);
}

// Numbers of all magnitudes at once: no square of a radius is a double.
TEST(Distance, ScalesMayDiffer) {
  const std::vector<Point<3>> a{{1e308, 1e308, 5e-324}, {-1e308, 1e308, 5e-324}, {0, -1e308, 5e-324}},
      b{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  Vector<3> near{};
  Distance_counts counts;
  EXPECT_TRUE(detail::is_apart<3>(a, b, least, near, counts));
  EXPECT_FALSE(detail::is_apart<3>(a, b, 2 * least, near, counts));
  EXPECT_FALSE(detail::is_apart<3>(a, b, 1e308, near, counts));
  EXPECT_EQ(detail::distance_rounded_down<3>(a, b), least);
}

}  // namespace
}  // namespace cellwalk
