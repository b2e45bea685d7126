// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/simulation/route.h>

#include <gtest/gtest.h>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

template <int D>
void expect_free(const Snapshot<D>& snapshot, const std::vector<Point<D>>& route) {
  auto particle = Locator<D>(snapshot).particle_at(route.front()).value();
  Walk_counts counts;
  for (const Point<D>& p : route)
    EXPECT_EQ(move<Exact>(snapshot, particle, p, counts).status, Walk_status::arrived);
}

TEST(Route, GoesRoundSolidCells) {
  // A wall of solid cells across a 5 x 5 room, open at the top.
  const auto snapshot = rooms<2>({5, 5}, {2, 7, 12, 17});
  const Locator<2> locator(snapshot);
  Walk_counts counts;
  const auto route = find_route(snapshot, locator.particle_at({0.5, 0.5}).value(),
                                locator.particle_at({4.5, 0.25}).value(), counts);
  ASSERT_GE(route.size(), 4u);
  EXPECT_LE(route.size(), 8u);
  EXPECT_EQ(route.front(), (Point<2>{0.5, 0.5}));
  EXPECT_EQ(route.back(), (Point<2>{4.5, 0.25}));
  expect_free(snapshot, route);
}

TEST(Route, IsStraightWhereNothingIsInTheWay) {
  const auto snapshot = rooms<3>({6, 6, 6});
  const Locator<3> locator(snapshot);
  Walk_counts counts;
  const auto route = find_route(snapshot, locator.particle_at({0.1, 0.1, 0.1}).value(),
                                locator.particle_at({5.9, 5.5, 5.2}).value(), counts);
  EXPECT_EQ(route.size(), 2u);
}

TEST(Route, IsEmptyWhereWallsForbidIt) {
  const auto snapshot = rooms<2>({3, 1}, {1});
  const Locator<2> locator(snapshot);
  Walk_counts counts;
  EXPECT_TRUE(find_route(snapshot, locator.particle_at({0.5, 0.5}).value(),
                         locator.particle_at({2.5, 0.5}).value(), counts)
                  .empty());
}

}  // namespace
}  // namespace cellwalk
