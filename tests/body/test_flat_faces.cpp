// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces that move in the plane of a membrane, with other faces and edges at the same vertex: all have it on
// sides that agree. The membrane is the square [10,11] x [5,6] at z = 1; each case has its mirror image.
#include <gtest/gtest.h>

#include "body/membrane_room.h"

namespace cellwalk::test {
namespace {

Environment<3> room() { return with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1}); }

/// A height beside the plane, and the one on its other side.
constexpr std::array<std::array<double, 2>, 2> mirrors{{{0.5, 1.5}, {1.5, 0.5}}};

TEST(FlatFaces, ASheetKeepsItsSideWhenTheMembraneComesFromOneFaceToTheNext) {
  const auto environment = room();
  for (const auto& [own, other] : mirrors) {
    SCOPED_TRACE(own);
    Moving sheet(environment.snapshot(), {{4, 11, own}, {10.5, 1, own}, {2, 6, own}, {20, 6, own}},
                 {{0, 1, 2}, {0, 3, 1}});
    ASSERT_TRUE(sheet.lift(1));
    ASSERT_FALSE(sheet.move(0, {18, 11, 1})) << "the common edge goes over it, on one side";
    EXPECT_FALSE(sheet.lift(other)) << "through it";
    EXPECT_TRUE(sheet.lift(own)) << "off it";
  }
}

TEST(FlatFaces, AMembraneStaysOutsideOfABodyWhoseBaseComesToIt) {
  const auto environment = room();
  for (const auto& [apex, away] : {std::array{0.25, 0.125}, std::array{1.75, -0.125}}) {
    SCOPED_TRACE(apex);
    Moving body(environment.snapshot(), {{4, 11, 1}, {10.5, 1, 1}, {2, 6, 1}, {5, 6, apex}},
                {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
    ASSERT_FALSE(body.move(0, {18, 11, 1}));
    EXPECT_FALSE(body.rise(away)) << "the membrane would be inside";
    EXPECT_TRUE(body.rise(-away));
  }
}

TEST(FlatFaces, WhatAFaceRestsOnDoesNotPassAnEdgeToAFaceOnTheOtherSide) {
  const auto environment = room();
  for (const auto& [own, other] : mirrors)
    for (const double neighbour : {own, other}) {
      SCOPED_TRACE(own);
      Moving faces(environment.snapshot(), {{4, 11, own}, {10.5, 1, own}, {20, 6, own}, {2, 6, own}},
                   {{0, 1, 2}, {0, 3, 1}});
      ASSERT_TRUE(faces.lift(1, 3));
      ASSERT_FALSE(faces.move(3, {2, 6, neighbour}));
      const auto contact = faces.move(0, {18, 11, 1});
      EXPECT_EQ(contact.has_value(), neighbour == other);
      if (contact) EXPECT_EQ(contact->rounded_time(), 0);
    }
}

TEST(FlatFaces, AMembraneThatPassesAFaceHasItAndBothNeighboursOnOneSide) {
  const auto environment = room();
  for (const double one : {0.25, 1.75})
    for (const double other : {0.25, 1.75}) {
      // It comes in over the edge 01 and leaves over the edge 02.
      Moving fan(environment.snapshot(), {{3, 11, 1}, {6, 1, 1}, {5, 1, 1}, {8, 2, one}, {3, 2, other}},
                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 4}});
      EXPECT_EQ(fan.move(0, {21, 11, 1}).has_value(), one != other) << one << " " << other;
    }
}

TEST(FlatFaces, AnEdgeOffThePlaneHoldsTheVertexOnItsSide) {
  const auto environment = room();
  for (const auto& [own, other] : mirrors) {
    SCOPED_TRACE(own);
    Moving body(environment.snapshot(), {{8, 5.5, own}, {20, 1, own}, {20, 10, own}, {7, 5.5, own}},
                {{0, 1, 2}}, {{0, 3}});
    ASSERT_TRUE(body.lift(1, 3));
    ASSERT_FALSE(body.move(3, {7, 5.5, other}));
    EXPECT_TRUE(body.move(0, {14, 5.5, 1})) << "the vertex goes over the membrane, from rim to rim";
  }
}

TEST(FlatFaces, AFaceIsOnTheSideThatItsNeighbourNeeds) {
  const auto environment = room();
  for (const auto& [apex, towards] : {std::array{0.25, -0.125}, std::array{1.75, 0.125}}) {
    SCOPED_TRACE(apex);
    for (const bool back : {false, true}) {
      Moving faces(environment.snapshot(), {{4, 11, 1}, {10.5, 1, 1}, {2, 6, 1}, {5, 6, apex}},
                   {{0, 1, 2}, {0, 3, 1}});
      ASSERT_FALSE(faces.move(0, {18, 11, 1}));
      EXPECT_EQ(faces.rise(back ? -towards : towards), !back);
    }
  }
}

}  // namespace
}  // namespace cellwalk::test
