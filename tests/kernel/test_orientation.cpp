// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

namespace cellwalk {
namespace {

TEST(Orientation, FollowsTheSignConventionOfCgal) {
  Predicate_counts counts;
  const Point<3> o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(Exact::orientation(counts, o, x, y, z), 1);
  EXPECT_EQ(Exact::orientation(counts, o, y, x, z), -1);
  EXPECT_EQ(Exact::orientation(counts, Point<2>{0, 0}, Point<2>{1, 0}, Point<2>{0, 1}), 1);
  EXPECT_EQ(counts.orientations, 3u);
  EXPECT_EQ(counts.fallbacks, 0u);
}

}  // namespace
}  // namespace cellwalk
