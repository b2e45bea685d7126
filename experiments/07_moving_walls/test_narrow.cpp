// SPDX-License-Identifier: LGPL-3.0-or-later
// The tests of walls and edges against each other, in positions of which most are degenerate.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include "judge.h"

namespace cellwalk::moving_walls {
namespace {

Point<3> lattice_point(Random& random) {
  Point<3> x;
  for (double& c : x) c = static_cast<double>(random.below(4));
  return x;
}

TEST(Narrow, ExactSignsAgreeWithFractions) {
  Random random(7);
  int passed = 0, touched = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Moving_wall wall{
        lattice_point(random), lattice_point(random), {lattice_point(random), lattice_point(random)}};
    const Edge edge{lattice_point(random), lattice_point(random)};
    const Point<3> turn = cross(wall.still[0] - wall.from, wall.still[1] - wall.from);
    if (wall.from == wall.to || turn == Point<3>{} || edge[0] == edge[1]) continue;
    Predicate_counts signs;
    Judgement counts;
    const bool expected = passes_by_fractions(wall, edge, counts);
    passed += expected;
    touched += static_cast<int>(counts.touches);
    EXPECT_EQ(passes_exactly(wall, edge, signs), expected) << "trial " << trial;
    if (counts.touches == 0) {
      EXPECT_EQ(passes_rounded<double>(wall, edge), expected) << "trial " << trial;
      EXPECT_EQ(passes_rounded<float>(wall, edge), expected) << "trial " << trial;
    }
  }
  EXPECT_GT(passed, 200);
  EXPECT_GT(touched, 500);
}

TEST(Narrow, AWallThatRestsOnAnEdgeMayLeaveItOnly) {
  // Free space lies above the wall, and the edge on it.
  const Edge edge{Point<3>{1, 1, 0}, Point<3>{1.5, 1, 0}};
  const auto passes_towards = [&](double height) {
    Predicate_counts signs;
    Judgement counts;
    const Moving_wall wall{{0, 0, 0}, {0, 0, height}, {Point<3>{4, 0, 0}, Point<3>{0, 4, 0}}};
    const bool result = passes_exactly(wall, edge, signs);
    EXPECT_EQ(passes_by_fractions(wall, edge, counts), result);
    EXPECT_EQ(counts.touches, 1u);
    return result;
  };
  EXPECT_TRUE(passes_towards(1));
  EXPECT_FALSE(passes_towards(-1));
}

TEST(Narrow, AWallMayComeToTouchAnEdge) {
  const Edge edge{Point<3>{1, 1, 0}, Point<3>{1.5, 1, 0}};
  const Moving_wall wall{{0, 0, -1}, {0, 0, 0}, {Point<3>{4, 0, 0}, Point<3>{0, 4, 0}}};
  Predicate_counts signs;
  Judgement counts;
  EXPECT_FALSE(passes_exactly(wall, edge, signs));
  EXPECT_FALSE(passes_by_fractions(wall, edge, counts));
  EXPECT_EQ(counts.touches, 1u);
}

}  // namespace
}  // namespace cellwalk::moving_walls
