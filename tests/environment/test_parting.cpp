// SPDX-License-Identifier: LGPL-3.0-or-later
// Certificates that boundary facets do not meet, against exact signs at places that corners may take.
#include <cellwalk/internal/environment/parting.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/exact.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace cellwalk {
namespace {

using detail::Zoned_corner;
using detail::Zoned_move;

template <int D>
using Facet = std::array<Point<D>, static_cast<std::size_t>(D)>;

template <int D>
Vector<D> random_direction(Random& random) {
  for (;;) {
    Vector<D> d;
    for (double& x : d) x = random.real(-1, 1);
    if (const double l = length(d); l > 0.1 && l < 1) return (1 / l) * d;
  }
}

bool crosses(const Point<3>& u, const Point<3>& v, const Facet<3>& f) {
  Predicate_counts counts;
  const auto side = [&](const auto&... x) { return Exact::orientation(counts, x...); };
  if (side(f[0], f[1], f[2], u) * side(f[0], f[1], f[2], v) > 0) return false;
  const int a = side(u, v, f[0], f[1]), b = side(u, v, f[1], f[2]), c = side(u, v, f[2], f[0]);
  return a * b >= 0 && b * c >= 0 && c * a >= 0;
}

bool crosses(const Point<2>& u, const Point<2>& v, const Facet<2>& f) {
  Predicate_counts counts;
  const auto side = [&](const auto&... x) { return Exact::orientation(counts, x...); };
  return side(f[0], f[1], u) * side(f[0], f[1], v) <= 0 && side(u, v, f[0]) * side(u, v, f[1]) <= 0;
}

/// The angle from one facet to another around what they share: 0 if they lie on each other.
double fold(const Facet<3>& f, const Facet<3>& g) {
  const Vector<3> edge = normalized(f[1] - f[0]);
  const auto beside = [&](const Point<3>& x) { return (x - f[0]) - dot(x - f[0], edge) * edge; };
  const Vector<3> x = beside(f[2]), y = beside(g[2]);
  return std::atan2(dot(edge, cross(x, y)), dot(x, y));
}

double fold(const Facet<2>& f, const Facet<2>& g) {
  const Vector<2> x = f[1] - f[0], y = g[1] - g[0];
  return std::atan2(x[0] * y[1] - x[1] * y[0], dot(x, y));
}

/// True if facets that share a ridge are folded onto each other somewhere between two places.
template <int D>
bool get_folded(const Facet<D>& f0, const Facet<D>& g0, const Facet<D>& f1, const Facet<D>& g1) {
  constexpr int steps = 16;
  double before = fold(f0, g0);
  for (int i = 1; i <= steps; ++i) {
    Facet<D> f = f0, g = g0;
    for (std::size_t k = 0; k < D; ++k) {
      f[k] = f[k] + (static_cast<double>(i) / steps) * (f1[k] - f0[k]);
      g[k] = g[k] + (static_cast<double>(i) / steps) * (g1[k] - g0[k]);
    }
    const double now = fold(f, g);
    if (now * before <= 0 && std::abs(now) + std::abs(before) < 3) return true;  // flat is far from 0
    before = now;
  }
  return false;
}

/// True if facets that share no ridge have more in common than a first corner.
template <int D>
bool meet(const Facet<D>& f, const Facet<D>& g, std::size_t common) {
  if constexpr (D == 2) return crosses(f[0], f[1], g);
  if constexpr (D == 3) {
    if (common == 1) return crosses(f[1], f[2], g) || crosses(g[1], g[2], f);
    for (std::size_t k = 0; k < 3; ++k)
      if (crosses(f[k], f[(k + 1) % 3], g) || crosses(g[k], g[(k + 1) % 3], f)) return true;
    return false;
  }
}

template <int D>
struct Pair {
  std::array<Zoned_corner<D>, static_cast<std::size_t>(D)> low, high;
  std::size_t common = 0, mover = 0;
  Zoned_move<D> move;
};

/// Facets of random corners with zones; corner `mover` of the first one moves.
template <int D>
Pair<D> random_pair(Random& random, std::size_t common) {
  Pair<D> pair;
  pair.common = common;
  pair.mover = random.below(D);
  for (std::size_t k = 0; k < D; ++k)
    for (auto* facet : {&pair.low, &pair.high}) {
      Zoned_corner<D>& c = (*facet)[k];
      c.name = static_cast<std::uint32_t>(facet == &pair.low || k < common ? k : 10 + k);
      for (double& x : c.zone.centre) x = random.real(0, 1);
      c.zone.radius = random.chance(0.3) ? 0 : random.real(0, 0.12);
      if (k < common) pair.high[k] = pair.low[k];
    }
  const Point<D>& to = pair.low[pair.mover].zone.centre;
  pair.move = {pair.low[pair.mover].name, to + random.real(0, 0.3) * random_direction<D>(random), to};
  return pair;
}

/// Where the corners are if all of one facet are pushed along a direction in their zones, those of the other
/// against it. The vertex that moves is on its way, or as far from its end as is allowed.
template <int D>
std::array<Facet<D>, 2> pushed(const Pair<D>& pair, double radius, const Vector<D>& d, double on_way,
                               bool is_hinge_high) {
  std::array<Facet<D>, 2> at;
  for (std::size_t k = 0; k < D; ++k) {
    const auto place = [&](const Zoned_corner<D>& c, double sense) {
      if (c.name != pair.move.vertex) return c.zone.centre + sense * c.zone.radius * d;
      if (on_way < 1) return pair.move.from + on_way * (pair.move.to - pair.move.from);
      return pair.move.to + sense * radius * d;
    };
    at[0][k] = place(pair.low[k], k < pair.common && is_hinge_high ? -0.999 : 0.999);
    at[1][k] = k < pair.common ? at[0][k] : place(pair.high[k], -0.999);
  }
  return at;
}

/// True if facets meet in one of many places that their corners may have.
template <int D>
bool can_meet(const Pair<D>& pair, double radius, Random& random) {
  const auto centres = pushed(pair, 0, Vector<D>{}, 1, false);
  for (int k = 0; k < 40; ++k) {
    Vector<D> d = random_direction<D>(random);
    if (k % 4 == 0) {  // straight towards each other
      for (std::size_t c = 0; c < D; ++c) d = d + 9.0 * (centres[1][c] - centres[0][c]);
      d = normalized(d);
    }
    const double on_way = k % 3 == 0 ? random.real(0, 1) : k % 3 == 1 ? 0 : 1;
    const auto [f, g] = pushed(pair, radius, d, on_way, k % 2 == 0);
    if (pair.common + 1 == D ? get_folded<D>(centres[0], centres[1], f, g) : meet<D>(f, g, pair.common))
      return true;
  }
  return false;
}

template <int D>
void check_pairs(std::size_t common) {
  Random random(7 + common);
  std::size_t parted = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Pair<D> pair = random_pair<D>(random, common);
    const double radius = detail::parting_radius<D>(pair.low, pair.high, pair.move, 1, true);
    if (radius < 0) continue;
    ++parted;
    ASSERT_FALSE(can_meet(pair, radius, random)) << "pair " << i << ", common " << common;
  }
  EXPECT_GT(parted, 500u) << common;
}

TEST(Parting, HoldsWhereverCornersAre) {
  check_pairs<2>(0);
  check_pairs<2>(1);
  check_pairs<3>(0);
  check_pairs<3>(1);
  check_pairs<3>(2);
}

TEST(Parting, OneFacetIsPartedFromManyAtOnce) {
  Random random(3);
  std::size_t parted = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t common = random.below(3);
    Pair<3> pair = random_pair<3>(random, common);
    std::vector<Zoned_corner<3>> star(pair.low.begin(), pair.low.end());
    Zoned_corner<3> fourth = pair.low[2];
    fourth.name = 20;
    fourth.zone.centre = fourth.zone.centre + 0.3 * random_direction<3>(random);
    star.push_back(fourth);
    const double radius = detail::parting_radius<3>(star, pair.high, pair.move, 1, false);
    if (radius < 0) continue;
    ++parted;
    // Each facet of the star has the vertex that moves.
    std::vector<Pair<3>> all{pair};
    for (std::size_t left_out = common; left_out < 3; ++left_out) {
      if (left_out == pair.mover) continue;
      all.push_back(pair);
      all.back().low[left_out] = fourth;
    }
    for (const Pair<3>& one : all) ASSERT_FALSE(can_meet(one, radius, random)) << i;
  }
  EXPECT_GT(parted, 500u);
}

TEST(Parting, EachSideGetsHalfOfTheRoom) {
  // A triangle above another one, at height 1.
  Pair<3> pair;
  const std::array<Point<3>, 3> base{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    pair.low[k] = {k, {base[k], 0}};
    pair.high[k] = {10 + k, {base[k] + Vector<3>{0, 0, 1}, 0}};
  }
  pair.move = {0, base[0], base[0]};
  EXPECT_NEAR(detail::parting_radius<3>(pair.low, pair.high, pair.move, 9, true), 0.49, 1e-9);
  EXPECT_NEAR(detail::parting_radius<3>(pair.low, pair.high, pair.move, 0.25, true), 0.49, 1e-9);
  pair.high[1].zone.radius = 0.75;  // more than its half
  EXPECT_NEAR(detail::parting_radius<3>(pair.low, pair.high, pair.move, 9, true), 0.98 * 0.25, 1e-9);
  pair.high[1].zone.radius = 1;
  EXPECT_LT(detail::parting_radius<3>(pair.low, pair.high, pair.move, 9, true), 0) << "they may touch";
}

TEST(Parting, NothingIsProvedOutOfTheRangeOfDoubles) {
  for (const double scale : {1e-160, 1e-110, 1e120, 1e300}) {
    Pair<3> pair;
    for (std::uint32_t k = 0; k < 3; ++k) {
      Point<3> x{};
      x[k] = scale;
      pair.low[k] = {k, {x, 0}};
      pair.high[k] = {10 + k, {x + Vector<3>{scale, scale, scale}, 0}};
    }
    pair.move = {0, pair.low[0].zone.centre, pair.low[0].zone.centre};
    EXPECT_LT(detail::parting_radius<3>(pair.low, pair.high, pair.move, 1, true), 0) << scale;
  }
  const detail::Zone<2> tiny{{0, 0}, 1e-200};
  EXPECT_TRUE(tiny.contains({0, 0}));
  EXPECT_FALSE(tiny.contains({1e-180, 0})) << "its square is 0 in doubles";
  const detail::Zone<2> unit{{1, 1}, 1};
  EXPECT_TRUE(unit.contains({1.5, 1.5}));
  EXPECT_FALSE(unit.contains({2, 2}));
}

}  // namespace
}  // namespace cellwalk
