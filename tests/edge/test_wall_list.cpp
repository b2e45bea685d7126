// SPDX-License-Identifier: LGPL-3.0-or-later
// What the list of walls says of a swept triangle is what each wall by itself says.
#include <gtest/gtest.h>

#include <iostream>

#include "edge/edge_worlds.h"

namespace cellwalk::test {
namespace {

template <int D>
void test_list() {
  int triangles = 0, crossed = 0, several = 0;
  for (std::uint64_t number = 0; number < 2 * oracle::world_kinds; ++number) {
    Edge_world<D> w(number, number % 3 == 0);
    for (int k = 0; k < 15; ++k) {
      const Particle<D> start = w.start();
      const Point<D> a = start.position, b = w.target(start), q = w.target(start);
      int crossing = 0;
      std::optional<double> first;
      for (const auto& wall : w.walls.polygons) {
        const auto time = first_crossing(a, b, q, wall);
        EXPECT_EQ(time.has_value(), crosses(a, b, q, wall));
        crossing += time.has_value();
        if (time && (!first || *time < *first)) first = time;
      }
      ++triangles;
      crossed += crossing > 0;
      several += crossing > 1;
      EXPECT_EQ(w.walls.is_crossed(a, b, q), crossing > 0) << w.world.name;
      EXPECT_EQ(w.walls.first_hit(a, b, q), first) << w.world.name;
    }
  }
  std::cout << D << "D: " << triangles << " triangles, crossed " << crossed << ", by several walls "
            << several << "\n";
  EXPECT_GT(triangles, 300);
  EXPECT_GT(crossed, 50);
  EXPECT_GT(triangles - crossed, 50);
  EXPECT_GT(several, 20);
}

TEST(WallList, SaysWhatEachWallSays2) { test_list<2>(); }
TEST(WallList, SaysWhatEachWallSays3) { test_list<3>(); }

/// All impassable facets are in it, by one side.
TEST(WallList, HoldsEachWallOnce) {
  for (std::uint64_t number = 0; number < oracle::world_kinds; ++number) {
    const Edge_world<3> w(number, true);
    std::size_t sides = 0, shared = 0;
    for (std::size_t i = 0; i < w.snapshot.cell_count(); ++i)
      for (std::size_t f = 0; f < w.snapshot.facet_count(w.snapshot.cell(i)); ++f)
        sides += w.snapshot.is_impassable(Snapshot<3>::half_facet(w.snapshot.cell(i), f));
    for (const Half_facet f : w.walls.facets) {
      EXPECT_TRUE(w.snapshot.is_impassable(f));
      shared += w.snapshot.opposite(f) != Half_facet::none;
    }
    EXPECT_GT(shared, 0u);
    EXPECT_EQ(sides, w.walls.facets.size() + shared);
  }
}

}  // namespace
}  // namespace cellwalk::test
