// SPDX-License-Identifier: LGPL-3.0-or-later
// The facets that a walk reports as crossed lead, one by one, through the cells it visited.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/strategy.h>

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "walk/oracle_worlds.h"

namespace cellwalk::oracle {
namespace {

struct Seen {
  int walks = 0, crossings = 0, ways_through_stars = 0;
};

/// Follows the facets from cell to cell; the visited ones must be met in order.
template <int D>
void expect_a_way(const Snapshot<D>& snapshot, Cell start, const Walk_result<D>& result,
                  const std::vector<Cell>& visited, const std::vector<Half_facet>& crossed) {
  Cell cell = start;
  std::size_t met = 1;  // of visited, which begins with the start
  for (const Half_facet f : crossed) {
    ASSERT_EQ(snapshot.cell_of(f), cell);
    ASSERT_FALSE(snapshot.is_impassable(f));
    cell = snapshot.neighbour(f);
    if (met < visited.size() && visited[met] == cell) ++met;
  }
  EXPECT_EQ(cell, result.cell);
  EXPECT_EQ(met, visited.size());
}

template <int D>
Seen walk_worlds(Walk_strategy strategy) {
  Seen seen;
  for (std::uint64_t number = 0; number < 4 * world_kinds; ++number) {
    const World<D> world = make_world<D>(number);
    const Snapshot<D> snapshot = Snapshot<D>::compile(world.soup, glue(world.soup));
    const Locator<D> locator(snapshot);
    Motion_source<D> source(world, number);
    for (int k = 0; k < 200; ++k) {
      const Motion_kind kind = source.kind(false);
      const Particle<D> particle = locator.particle_at(source.start(kind)).value_or(Particle<D>{});
      if (particle.cell == Cell::none) continue;
      const Point<D> target = source.target(kind, particle.position, particle.position);
      std::vector<Cell> visited;
      std::vector<Half_facet> crossed;
      Walk_counts counts;
      const auto result = walk(snapshot, particle, target, counts, strategy, {&visited, &crossed});
      expect_a_way(snapshot, particle.cell, result, visited, crossed);
      ++seen.walks;
      seen.crossings += static_cast<int>(crossed.size());
      seen.ways_through_stars += crossed.size() + 1 > visited.size();
    }
  }
  return seen;
}

template <int D>
void test_strategies() {
  for (const auto strategy :
       {Walk_strategy::certified, Walk_strategy::exit_rule, Walk_strategy::predictive_simplex}) {
    const Seen seen = walk_worlds<D>(strategy);
    EXPECT_GT(seen.walks, 3000);
    EXPECT_GT(seen.crossings, 3000);
    EXPECT_GT(seen.ways_through_stars, 300);
  }
}

TEST(WalkCrossed, LeadsThroughTheCellsVisited2) { test_strategies<2>(); }
TEST(WalkCrossed, LeadsThroughTheCellsVisited3) { test_strategies<3>(); }

}  // namespace
}  // namespace cellwalk::oracle
