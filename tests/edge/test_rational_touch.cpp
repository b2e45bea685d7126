// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle of touches, by hand: touches at corners, rims and insides, in the plane of the obstacle, at the
// start, and by triangles that are segments.
#include <gtest/gtest.h>

#include <vector>

#include "edge/rational_touch.h"

namespace cellwalk::test {
namespace {

/// In the plane z = 0.
const std::vector<Point<3>> triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
const std::vector<Point<3>> segment{{0, 0, 0}, {4, 0, 0}};

void expect(const Rational_touch& touch, bool at_start, std::optional<Rational> later) {
  EXPECT_EQ(touch.at_start, at_start);
  EXPECT_EQ(touch.later, later);
  EXPECT_EQ(touch.any(), at_start || later);
}

TEST(RationalTouch, OfAPoint) {
  expect(touch_of_point({1, 1, 1}, {1, 1, -3}, triangle), false, Rational(1, 4));
  expect(touch_of_point({1, 1, 1}, {1, 1, 0}, triangle), false, Rational(1));
  expect(touch_of_point({2, 2, 3}, {2, 2, -1}, triangle), false, Rational(3, 4));  // on the rim
  expect(touch_of_point({4, 0, 1}, {4, 0, -1}, triangle), false, Rational(1, 2));  // on a corner
  expect(touch_of_point({4, 1, 1}, {4, 1, -1}, triangle), false, {});              // past it
  expect(touch_of_point({1, 1, 2}, {1, 1, 1}, triangle), false, {});
  expect(touch_of_point({1, 1, 0}, {1, 1, 1}, triangle), true, {});           // leaves it
  expect(touch_of_point({1, 1, 0}, {1, 2, 0}, triangle), true, Rational(0));  // slides on it
  expect(touch_of_point({1, 1, 0}, {1, 1, 0}, triangle), true, {});           // rests
  expect(touch_of_point({-1, 1, 0}, {3, 1, 0}, triangle), false, Rational(1, 4));
}

TEST(RationalTouch, OfAnEdge) {
  // q below the plane at (1,1), p moving above it.
  expect(touch_of_edge({9, 1, 1}, {1, 1, 1}, {1, 1, -1}, triangle), false, Rational(1, 2));
  expect(touch_of_edge({1, 1, 1}, {9, 1, 1}, {1, 1, -1}, triangle), true, Rational(0));
  // The triangle is pierced by none of the three segments.
  const std::vector<Point<3>> small{{0, 0, 1}, {0.25, 0.25, -1}, {-0.25, 0.25, -1}};
  expect(touch_of_edge({-4, -1, 0}, {4, -1, 0}, {0, 7, 0}, small), false, Rational(53, 110));
  // q rests on the obstacle: no contact of its own. Then p comes down on it, too.
  expect(touch_of_edge({1, 1, 4}, {2, 1, 3}, {1, 1, 0}, triangle), true, {});
  expect(touch_of_edge({1, 2, 4}, {2, 1, 0}, {1, 1, 0}, triangle), true, Rational(1));
  // In the plane of the obstacle.
  expect(touch_of_edge({0, 5, 0}, {6, 5, 0}, {0, -1, 0}, triangle), true, Rational(0));
  expect(touch_of_edge({-2, 5, 0}, {4, 5, 0}, {-2, -1, 0}, triangle), false, Rational(2, 5));
}

TEST(RationalTouch, OfAnEdgeWithASegment) {
  expect(touch_of_edge({1, -1, 1}, {1, 3, 1}, {1, -1, -1}, segment), false, Rational(1, 2));
  expect(touch_of_edge({4, -1, 1}, {4, 3, 1}, {4, -1, -1}, segment), false, Rational(1, 2));
  expect(touch_of_edge({5, -1, 1}, {5, 3, 1}, {5, -1, -1}, segment), false, {});
  expect(touch_of_edge({1, 1, 1}, {1, 3, 1}, {1, 1, -1}, segment), false, {});
  expect(touch_of_edge({1, 0, 1}, {2, 0, 1}, {1, 0, -1}, segment), true,
         Rational(0));  // its line in the triangle
  EXPECT_TRUE(segment_meets({-1, 0, 0}, {0, 0, 0}, segment));
  EXPECT_FALSE(segment_meets({-2, 0, 0}, {-1, 0, 0}, segment));
  EXPECT_TRUE(segment_meets({3, 0, 0}, {9, 0, 0}, segment));
  EXPECT_TRUE(segment_meets({1, 1, 1}, {3, -1, -1}, segment));
}

TEST(RationalTouch, OfAnEdgeThatMovesInItsLine) {
  // Away from q, through the triangle; toward q; past q.
  expect(touch_of_edge({1, 1, 1}, {1, 1, -3}, {1, 1, 2}, triangle), false, Rational(1, 4));
  expect(touch_of_edge({1, 1, 3}, {1, 1, 1}, {1, 1, -1}, triangle), true, {});
  expect(touch_of_edge({1, 1, 3}, {1, 1, -1}, {1, 1, 2}, triangle), false, Rational(3, 4));
  expect(touch_of_edge({1, 1, 3}, {1, 1, -1}, {1, 1, 0}, triangle), true, {});
  expect(touch_of_edge({1, 1, 3}, {1, 1, 3}, {1, 1, -1}, triangle), true, {});
  // Along the obstacle: what it meets beyond q is met from then on.
  expect(touch_of_edge({6, 0, 0}, {2, 0, 0}, {3, 0, 0}, segment), true, Rational(3, 4));
}

}  // namespace
}  // namespace cellwalk::test
