// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces that move in the plane of a membrane, with other faces and edges at the same vertex: all have it on
// sides that agree. The membrane is the square [10,11] x [5,6] at z = 1; each case has its mirror image.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <span>

#include "body/membrane_room.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

Environment<3> membrane_room() { return with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1}); }

/// A height beside the plane, and the one on its other side.
constexpr std::array<std::array<double, 2>, 2> mirrors{{{0.5, 1.5}, {1.5, 0.5}}};

TEST(FlatFaces, ASheetKeepsItsSideWhenTheMembraneComesFromOneFaceToTheNext) {
  const auto environment = membrane_room();
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
  const auto environment = membrane_room();
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
  const auto environment = membrane_room();
  for (const auto& [own, other] : mirrors)
    for (const double neighbour : {own, other}) {
      SCOPED_TRACE(own);
      Moving faces(environment.snapshot(), {{4, 11, own}, {10.5, 1, own}, {20, 6, own}, {2, 6, own}},
                   {{0, 1, 2}, {0, 3, 1}});
      ASSERT_TRUE(faces.lift(1, 3));
      ASSERT_FALSE(faces.move(3, {2, 6, neighbour}));
      const auto contact = faces.move(0, {18, 11, 1});
      EXPECT_EQ(contact.has_value(), neighbour == other);
      if (contact) {
        EXPECT_EQ(contact->time, 0);
        EXPECT_EQ(contact->body, Body_feature::face);
        EXPECT_EQ(contact->feature, 0u) << "the face that moves in the plane";
      }
    }
}

TEST(FlatFaces, AMembraneThatPassesAFaceHasItAndBothNeighboursOnOneSide) {
  const auto environment = membrane_room();
  for (const double one : {0.25, 1.75})
    for (const double other : {0.25, 1.75}) {
      // It comes in over the edge 01 and leaves over the edge 02.
      Moving fan(environment.snapshot(), {{3, 11, 1}, {6, 1, 1}, {5, 1, 1}, {8, 2, one}, {3, 2, other}},
                 {{0, 1, 2}, {0, 3, 1}, {0, 2, 4}});
      EXPECT_EQ(fan.move(0, {21, 11, 1}).has_value(), one != other) << one << " " << other;
    }
}

TEST(FlatFaces, AnEdgeOffThePlaneHoldsTheVertexOnItsSide) {
  const auto environment = membrane_room();
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
  const auto environment = membrane_room();
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

/// True if a point lies strictly inside of a tetrahedron.
bool is_inside(std::span<const Point<3>> corners, const Point<3>& x) {
  Predicate_counts counts;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<Point<3>, 4> with{corners[0], corners[1], corners[2], corners[3]};
    const int own = Exact::orientation(counts, with[0], with[1], with[2], with[3]);
    with[k] = x;
    if (own == 0 || Exact::orientation(counts, with[0], with[1], with[2], with[3]) != own) return false;
  }
  return true;
}

// A tetrahedron with its base in the plane moves its corners there over a membrane, and then off the plane,
// to both sides: the membrane is not inside of it, and one side is free.
TEST(FlatFaces, NoMembraneComesIntoABodyThatMovesInItsPlane) {
  Random random(7);
  const auto some = [&](double low, double high) {
    return low + static_cast<double>(random.below(static_cast<std::uint64_t>(2 * (high - low)) + 1)) / 2;
  };
  std::size_t moved = 0, over = 0, blocked = 0;
  const std::size_t worlds = oracle::scaled_count(12);
  for (std::size_t k = 0; k < worlds && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const Point<3> low{std::floor(some(3, 5)), std::floor(some(1, 3)), 1};
    const auto environment =
        with_membranes({low[0] - 0.1, low[1] - 0.1, 0.9}, {low[0] + 1.1, low[1] + 1.1, 1.1}, 8, 5);
    const Point<3> centre{low[0] + 0.5, low[1] + 0.5, 1};
    for (int tries = 0; tries < 10; ++tries) {
      std::vector<Point<3>> corners;
      for (int i = 0; i < 3; ++i)
        corners.push_back({some(0.5, low[0] - 0.5), some(0.5, 4.5), 1});  // beside it
      corners.push_back({some(0.5, 7.5), some(0.5, 4.5), random.below(2) == 0 ? 0.25 : 1.75});
      // A base with an area, seen from above.
      Predicate_counts counts;
      const Point<3> above{centre[0], centre[1], 5};
      if (Exact::orientation(counts, corners[0], corners[1], corners[2], above) == 0) continue;
      Moving body(environment.snapshot(), corners, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
      for (int i = 0; i < 4; ++i) {
        const auto v = static_cast<std::uint32_t>(random.below(3));
        const bool is_blocked = body.move(v, {some(0.5, 7.5), some(0.5, 4.5), 1}).has_value();
        moved += !is_blocked;
        blocked += is_blocked;
      }
      for (const double by : {0.125, -0.125}) {
        Moving copy = body;
        const bool is_free = copy.rise(by);
        EXPECT_FALSE(is_inside(copy.positions(), centre)) << by;
        over += !is_free;
        if (!is_free) {
          Moving other = body;
          EXPECT_TRUE(other.rise(-by)) << "nothing holds it there";
        }
      }
    }
  }
  std::printf("%zu moves in the plane, %zu blocked; a membrane under %zu bodies\n", moved, blocked, over);
  if (!oracle::is_shortened()) {
    EXPECT_GT(over, worlds);
  }
}

}  // namespace
}  // namespace cellwalk::test
