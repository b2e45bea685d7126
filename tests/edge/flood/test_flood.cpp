// SPDX-License-Identifier: LGPL-3.0-or-later
// The flood of a swept triangle meets each wall that crosses it; in general position it meets no other.
#include <cellwalk/internal/edge/may_intersect.h>

#include <gtest/gtest.h>

#include "edge/edge_worlds.h"

namespace cellwalk::test {
namespace {

struct Flood_seen {
  int triangles = 0, clear = 0, crossed = 0, undecided = 0;
};

template <int D>
Flood_seen flood(bool generic) {
  Flood_seen seen;
  Edge_counts counts;
  for (std::uint64_t number = 0; number < 3 * oracle::world_kinds; ++number) {
    Edge_world<D> w(number, generic);
    for (int k = 0; k < 100; ++k) {
      const Particle<D> p = w.start();
      if (p.cell == Cell::none) continue;
      const Point<D> b = w.target(p);
      w.choose_kind();
      const Point<D> q = w.target(p);
      detail::Flooded found;
      const bool clear = detail::flood<D>(w.snapshot, p.cell, {p.position, b, q}, counts, 1000, found,
                                          [](Half_facet) { return false; });
      const bool is_hit = w.walls.is_crossed(p.position, b, q);
      ++seen.triangles;
      seen.clear += clear;
      seen.crossed += is_hit;
      seen.undecided += !clear && !is_hit;
      if (clear) {
        EXPECT_FALSE(is_hit) << w.world.name;
      }
    }
  }
  EXPECT_EQ(counts.floods, static_cast<std::uint64_t>(seen.triangles));
  return seen;
}

template <int D>
void test_floods() {
  const Flood_seen generic = flood<D>(true), degenerate = flood<D>(false);
  EXPECT_GT(generic.clear, 200);
  EXPECT_GT(generic.crossed, 200);
  EXPECT_EQ(generic.undecided, 0);
  EXPECT_GT(degenerate.clear, 50);
  EXPECT_GT(degenerate.crossed, 200);
  EXPECT_GT(degenerate.undecided, 100) << "walls that touch";
}

TEST(Flood, FindsWhatIsClear2) { test_floods<2>(); }
TEST(Flood, FindsWhatIsClear3) { test_floods<3>(); }

}  // namespace
}  // namespace cellwalk::test
