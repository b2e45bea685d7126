// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces and edges that move in the plane of walls: what they need at all times, not at the end alone.
#include <gtest/gtest.h>

#include <utility>

#include "body/membrane_room.h"

namespace cellwalk::test {
namespace {

TEST(FacesInPlanes, StayOnTheirSideOfWallsThatAreJoined) {
  const auto environment = with_membranes({8.9, 4.9, 0.9}, {20.1, 6.1, 1.1});
  int arrived = 0;
  for (const double z : {0.5, 1.5})
    for (const int steps : {1, 2, 20}) {
      SCOPED_TRACE(z);
      Moving face(environment.snapshot(), {{21, 11, z}, {11, 1, z}, {21, 1, z}}, {{0, 1, 2}});
      ASSERT_TRUE(face.lift(1)) << "onto the membranes";
      // It leaves those on which it rests, and comes to others beside them.
      bool is_free = true;
      for (int k = 1; k <= steps && is_free; ++k) is_free = !face.move(0, {21 - 20. * k / steps, 11, 1});
      arrived += is_free;
      EXPECT_FALSE(face.lift(2 - z)) << "through them";
      EXPECT_TRUE(face.lift(z)) << "off them";
    }
  EXPECT_GE(arrived, 3) << "no side is blocked by nothing";
}

/// A tetrahedron whose edge 01 moves in the plane z = 1, and heights of its other corners.
struct Wedge {
  Wedge(const Snapshot<3>& snapshot, double one, double other)
      : body(snapshot, {{4, 11, 1}, {10.5, 1, 1}, {2, 6, one}, {2, 6, other}},
             {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}) {}
  Moving body;
};

TEST(FacesInPlanes, NothingComesBetweenFacesThatShareAnEdge) {
  const auto environment = with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1});
  const auto contact = Wedge(environment.snapshot(), 1.75, 0.25).body.move(0, {18, 11, 1});
  ASSERT_TRUE(contact);
  // The edge meets the corner (10, 5) first, when its moving end is at x = 9.25.
  EXPECT_EQ(contact->exact_time(), Exact_time(0.375));
  EXPECT_EQ(contact->point, (Point<3>{10, 5, 1}));
  EXPECT_EQ(contact->kind, Contact_kind::vertex);
  EXPECT_EQ(contact->body, Body_feature::edge);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_LT(contact->normal[0], -0.9) << "against the motion";
  EXPECT_EQ(contact->normal[2], 0);
  // In parts as in one.
  Wedge slow(environment.snapshot(), 1.75, 0.25);
  EXPECT_FALSE(slow.body.move(0, {9, 11, 1}));
  EXPECT_TRUE(slow.body.move(0, {9.5, 11, 1}));
}

TEST(FacesInPlanes, AWallInWhichTheEdgeEndsIsMetWhenTheEdgeMeetsIt) {
  const auto environment = with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1});
  for (const double x : {9.5, 10.5, 11.5, 13.0}) {
    const auto contact = Wedge(environment.snapshot(), 1.75, 0.25).body.move(0, {x, 11, 1});
    ASSERT_TRUE(contact) << x;
    EXPECT_NEAR(contact->time, 5.25 / (x - 4), 1e-12);
    EXPECT_EQ(contact->normal[2], 0);
  }
  EXPECT_FALSE(Wedge(environment.snapshot(), 1.75, 0.25).body.move(0, {9.25, 11, 1})) << "touches it";
}

TEST(FacesInPlanes, FacesOnOneSideOfAWallAreFree) {
  const auto environment = with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1});
  for (const auto& [one, other] : {std::pair{1.75, 1.25}, {0.25, 0.75}})
    EXPECT_FALSE(Wedge(environment.snapshot(), one, other).body.move(0, {18, 11, 1}));
  // The membrane is beside the way of the edge, or behind its end.
  for (const auto& [low, high] : {std::pair{Point<3>{16.9, 4.9, 0.9}, Point<3>{18.1, 6.1, 1.1}},
                                  {Point<3>{4.9, 0.9, 0.9}, Point<3>{6.1, 2.1, 1.1}}}) {
    const auto other = with_membranes(low, high);
    EXPECT_FALSE(Wedge(other.snapshot(), 1.75, 0.25).body.move(0, {18, 11, 1}));
  }
}

}  // namespace
}  // namespace cellwalk::test
