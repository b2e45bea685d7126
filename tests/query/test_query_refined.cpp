// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions through blocks that did not conform, judged by the boxes alone.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "environment/refine/random_blocks.h"

namespace cellwalk {
namespace {

using test::Block;

constexpr double extent = 8;

/// The part of a convex polygon (a segment or triangle in space) within a box; rounded.
template <int D>
std::vector<Point<D>> clipped(std::vector<Point<D>> polygon, const Block<D>& block) {
  for (std::size_t k = 0; k < D; ++k)
    for (const double sign : {1., -1.}) {
      const double bound = sign > 0 ? block.low[k] : -block.high[k];
      std::vector<Point<D>> rest;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = sign * p[k] - bound, at_q = sign * q[k] - bound;
        if (at_p >= 0) rest.push_back(p);
        if (at_p * at_q < 0) rest.push_back(p + (at_p / (at_p - at_q)) * (q - p));
      }
      polygon = std::move(rest);
    }
  return polygon;
}

/// True if it meets the inside of a block that was left out.
template <int D>
bool is_blocked(const std::vector<Point<D>>& polygon, const std::vector<Block<D>>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block<D>& block) {
    return !block.is_there && !clipped<D>(polygon, block).empty();
  });
}

template <int D>
struct World {
  std::vector<Block<D>> blocks;
  Environment<D> environment;
};

/// Turned by an angle about each of two axes: rounded.
Point<2> turned(const Point<2>& p) {
  return {std::cos(0.4) * p[0] - std::sin(0.4) * p[1], std::sin(0.4) * p[0] + std::cos(0.4) * p[1]};
}
Point<3> turned(const Point<3>& p) {
  const Point<2> xy = turned(Point<2>{p[0], p[1]}), yz = turned(Point<2>{xy[1], p[2]});
  return {xy[0], yz[0], yz[1]};
}

/// Blocks, some of tetrahedra; none if crossings of diagonals cannot be represented. With a tolerance they
/// are turned.
template <int D>
std::optional<World<D>> world(std::uint64_t seed, double absent, double in_tetrahedra, double tolerance = 0) {
  Random random(seed);
  auto blocks = test::random_blocks<D>(random, extent, 4 + random.below(20), absent);
  Cell_soup<D> soup = test::cells_of(blocks, random, in_tetrahedra);
  Soup_groups groups;
  if (tolerance != 0)
    for (Point<D>& p : soup.points) p = turned(p);
  try {
    if (soup.cell_count() == 0 || refine(soup, groups, tolerance).pieces == 0) return {};
  } catch (const Error&) {
    return {};
  }
  return World<D>{std::move(blocks), Environment<D>::build(std::move(soup), {.split = tolerance != 0})};
}

/// A point of a block that is there.
template <int D>
Point<D> inside(const std::vector<Block<D>>& blocks, Random& random) {
  for (;;) {
    Point<D> p;
    for (double& x : p) x = random.real(0, extent);
    if (!is_blocked<D>({p, p}, blocks)) return p;
  }
}

struct Counts {
  int worlds = 0, free = 0, blocked = 0, free_sweeps = 0, blocked_sweeps = 0;
};

/// Random motions among blocks, some of which are left out.
template <int D>
Counts judge(std::uint64_t first_seed, double in_tetrahedra, double tolerance = 0) {
  Counts counts;
  Edge_counts work;
  for (std::uint64_t seed = first_seed; seed < first_seed + 60; ++seed) {
    SCOPED_TRACE(seed);
    const auto made = world<D>(seed, 0.2, in_tetrahedra, tolerance);
    const auto at = [&](const Point<D>& p) { return tolerance == 0 ? p : turned(p); };
    if (!made) continue;
    ++counts.worlds;
    const auto& [blocks, environment] = *made;
    const Snapshot<D>& snapshot = environment.snapshot();
    const Locator<D> locator(snapshot);
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      const Point<D> a = inside(blocks, random), b = inside(blocks, random);
      // Half of the edges and motions are short.
      const double length = i % 2 == 0 ? 1 : 0.2;
      const Point<D> target = a + length * (inside(blocks, random) - a), q = a + length * (b - a);
      const bool way_is_blocked = is_blocked<D>({a, b}, blocks);
      EXPECT_EQ(answer_move(snapshot, locator, at(a), at(b), Touch::pass, work).status,
                way_is_blocked ? Motion_status::contact : Motion_status::free);
      ++(way_is_blocked ? counts.blocked : counts.free);
      if (is_blocked<D>({a, q}, blocks)) continue;
      const bool sweep_is_blocked = is_blocked<D>({a, target, q}, blocks);
      EXPECT_EQ(answer_sweep(snapshot, locator, {at(a), at(target), at(q)}, {}, work).status,
                sweep_is_blocked ? Motion_status::contact : Motion_status::free);
      ++(sweep_is_blocked ? counts.blocked_sweeps : counts.free_sweeps);
    }
    if (testing::Test::HasFailure()) break;
  }
  return counts;
}

void expect_all_kinds(const Counts& counts, int worlds) {
  EXPECT_GE(counts.worlds, worlds);
  EXPECT_GE(counts.free, 10 * worlds);
  EXPECT_GE(counts.blocked, 10 * worlds);
  EXPECT_GE(counts.free_sweeps, 10 * worlds);
  EXPECT_GE(counts.blocked_sweeps, 5 * worlds);
}

TEST(QueryRefined, MotionsAmongBlocksAreBlockedWhereBlocksAreLeftOut) {
  expect_all_kinds(judge<3>(100, 0), 50);
  expect_all_kinds(judge<2>(200, 0.5), 50);
  expect_all_kinds(judge<3>(300, 0.1), 10);
}

TEST(QueryRefined, SoTheyAreAmongTurnedBlocksWithinATolerance) {
  expect_all_kinds(judge<3>(400, 0, 1e-9), 50);
  expect_all_kinds(judge<2>(500, 0.5, 1e-9), 50);
  expect_all_kinds(judge<3>(600, 0.2, 1e-9), 40);
}

/// In a box that is full, everything is free: also along facets, edges and diagonals of blocks.
template <int D>
void judge_full(std::uint64_t first_seed, double in_tetrahedra) {
  int worlds = 0;
  Edge_counts work;
  for (std::uint64_t seed = first_seed; seed < first_seed + 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto made = world<D>(seed, 0, in_tetrahedra);
    if (!made) continue;
    ++worlds;
    const Snapshot<D>& snapshot = made->environment.snapshot();
    const Locator<D> locator(snapshot);
    Random random(seed);
    const auto lattice_point = [&] {
      Point<D> p;
      for (double& x : p) x = 0.5 * static_cast<double>(random.below(17));
      return p;
    };
    for (int i = 0; i < 100; ++i) {
      const Point<D> p = lattice_point(), target = lattice_point(), q = lattice_point();
      EXPECT_EQ(answer_move(snapshot, locator, p, target, Touch::pass, work).status, Motion_status::free);
      EXPECT_EQ(answer_sweep(snapshot, locator, {p, target, q}, {}, work).status, Motion_status::free);
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GE(worlds, in_tetrahedra > 0 && D == 3 ? 5 : 30);
}

TEST(QueryRefined, AFullBoxIsFreeInEveryPosition) {
  judge_full<3>(1000, 0);
  judge_full<2>(2000, 0.5);
  judge_full<3>(3000, 0.1);
}

}  // namespace
}  // namespace cellwalk
