// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies with parts that have one vertex alone in common, which passes along a ridge of walls: no wall comes
// between the parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "body/membrane_room.h"

namespace cellwalk::test {
namespace {

/// A room of cubes with the walls of which the centres are given.
Environment<3> with_walls(const std::vector<Point<3>>& centres) {
  Grid_options<3> options;
  options.cells = {14, 12, 12};
  auto environment = Environment<3>::build(hex_grid(options));
  const Snapshot<3>& snapshot = environment.snapshot();
  std::size_t made = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      if (snapshot.neighbour(f) == Cell::none || snapshot.is_impassable(f)) continue;
      if (std::find(centres.begin(), centres.end(), centroid(snapshot, f)) == centres.end()) continue;
      environment.set_impassable(f, true);
      ++made;
    }
  EXPECT_EQ(made, centres.size());
  return environment;
}

// The ways lead from x = 6 to x = 9 on the line y = z = 6. On its piece from 7 to 8 a wall may stand below,
// behind, above and before.
constexpr Point<3> ridge_start{6, 6, 6}, ridge_target{9, 6, 6};
const Point<3> below{7.5, 6, 5.5}, behind{7.5, 5.5, 6}, above{7.5, 6, 6.5}, before{7.5, 6.5, 6};

/// Where the quarters between these walls are, as seen from the line.
struct Quarter {
  double y, z;
};
constexpr Quarter below_behind{-1, -1}, above_behind{-1, 1}, above_before{1, 1}, below_before{1, -1};

Point<3> at(double x, double y, double z) { return {x, 6 + y, 6 + z}; }

/// A face with edges in the planes y = 6 and z = 6, between the walls at a quarter.
std::array<Point<3>, 2> face_in(const Quarter& q) { return {at(7.5, 0, 5 * q.z), at(7.5, 5 * q.y, 0)}; }

std::optional<Contact<3>> move_face_and_edge(const Environment<3>& room, const Quarter& face,
                                             const Quarter& edge, bool is_back = false) {
  const auto [q, r] = face_in(face);
  Moving body(room.snapshot(), {is_back ? ridge_target : ridge_start, q, r, at(7.5, 4 * edge.y, 5 * edge.z)},
              {{0, 1, 2}}, {{0, 3}});
  return body.move(0, is_back ? ridge_start : ridge_target);
}

constexpr std::array quarters{below_behind, above_behind, above_before, below_before};

/// True if one can turn about the line from one quarter to another one, between walls.
bool are_linked(std::size_t from, std::size_t to, const std::array<bool, 4>& has_wall_after) {
  const auto is_free = [&](std::size_t k, std::size_t end) {
    for (; k % 4 != end; ++k)
      if (has_wall_after[k % 4]) return false;
    return true;
  };
  return is_free(from, to) || is_free(to, from);
}

TEST(PinchedBodies, WallsAtTheWayDoNotComeBetweenAFaceAndAnEdge) {
  const std::array walls{behind, above, before, below};  // after the quarter of this number
  int blocked = 0, free = 0;
  for (unsigned set = 0; set < 16; ++set) {
    std::vector<Point<3>> centres;
    std::array<bool, 4> has_wall{};
    for (std::size_t k = 0; k < 4; ++k) {
      has_wall[k] = (set >> k) % 2 == 1;
      if (has_wall[k]) centres.push_back(walls[k]);
    }
    const auto room = with_walls(centres);
    for (std::size_t k = 0; k < 32; ++k) {
      const std::size_t face = k / 8, edge = k / 2 % 4;
      const bool is_back = k % 2 == 1;
      if (is_back && set % 3 != 0) continue;
      const auto contact = move_face_and_edge(room, quarters[face], quarters[edge], is_back);
      SCOPED_TRACE(testing::Message() << set << " " << face << " " << edge << " " << is_back);
      EXPECT_EQ(contact.has_value(), !are_linked(face, edge, has_wall));
      ++(contact ? blocked : free);
      if (!contact) continue;
      EXPECT_EQ(contact->time, 1.0 / 3);
      EXPECT_EQ(contact->point, at(is_back ? 8 : 7, 0, 0));
      EXPECT_EQ(contact->vertex, 0u);
    }
  }
  EXPECT_GT(blocked, 80);
  EXPECT_GT(free, 200);
}

TEST(PinchedBodies, WallsAtTheWayDoNotComeBetweenTwoFaces) {
  const std::array has_wall{true, false, false, true};
  const auto room = with_walls({behind, below});
  for (std::size_t one = 0; one < 4; ++one)
    for (std::size_t other = 0; other < 4; ++other) {
      SCOPED_TRACE(testing::Message() << one << " " << other);
      const auto [q, r] = face_in(quarters[one]);
      const auto [y, z] = quarters[other];
      Moving body(room.snapshot(), {ridge_start, q, r, at(7.5, 3 * y, 4 * z), at(7.5, 4 * y, 3 * z)},
                  {{0, 1, 2}, {0, 3, 4}});
      EXPECT_EQ(body.move(0, ridge_target).has_value(), !are_linked(one, other, has_wall));
    }
}

/// A face in the quarter below and behind, between walls there, and an edge to a point in the half-plane of
/// one of them, or in the line of the way. The edges of the face pass the walls outside, as the vertex does.
struct Bare_edge {
  const char* where;
  Point<3> end, landed_from;
  bool is_at_piece;  ///< it lies between the walls from the start
};

// Such an edge is where the vertex passes, and that is where the face is, unless the edge lies elsewhere
// already.
TEST(PinchedBodies, ABareEdgePassesWithTheFaceUnlessItIsThereBefore) {
  const auto room = with_walls({behind, below});
  const auto [q, r] = face_in(below_behind);
  const std::array<Bare_edge, 5> edges{
      {{"from above the wall behind", at(9, -4, 0), at(9, -4, 1), false},
       {"from before the wall below", at(9, 0, -4), at(9, 1, -4), false},
       {"behind that wall at the end", at(6.25, -4, 0), at(6.25, -4, 0), false},
       {"in the line, ahead", at(10, 0, 0), at(10, 0, 0), true},
       {"in the line, behind", at(5, 0, 0), at(5, 0, 0), false}}};
  for (const Bare_edge& edge : edges) {
    SCOPED_TRACE(edge.where);
    Moving body(room.snapshot(), {ridge_start, q, r, edge.landed_from}, {{0, 1, 2}}, {{0, 3}});
    ASSERT_FALSE(body.move(3, edge.end));
    const auto contact = body.move(0, ridge_target);
    EXPECT_EQ(contact.has_value(), edge.is_at_piece);
    if (contact) {
      EXPECT_EQ(contact->time, 1.0 / 3);
      EXPECT_EQ(contact->point, at(7, 0, 0));
    }
    Moving alone(room.snapshot(), {ridge_start, edge.landed_from}, {}, {{0, 1}});
    ASSERT_FALSE(alone.move(1, edge.end));
    EXPECT_FALSE(alone.move(0, ridge_target)) << "without the face";
  }
}

TEST(PinchedBodies, OneWallPartsNothing) {
  const auto room = with_walls({below});
  for (const Quarter& face : quarters)
    for (const Quarter& edge : quarters) EXPECT_FALSE(move_face_and_edge(room, face, edge));
}

// The vertex passes two membranes side by side: inside of one, or along the ridge between them, where it is
// in neither, and yet all that it takes along is on one side of both.
TEST(PinchedBodies, MembranesSideBySideHoldAllOnOneSide) {
  const auto environment = with_membranes({9.9, 3.9, 0.9}, {11.1, 6.1, 1.1});
  for (const double y : {5.5, 5.0})
    for (const double own : {0.5, 1.5})
      for (const double other : {0.5, 1.5}) {
        SCOPED_TRACE(testing::Message() << y << " " << own << " " << other);
        Moving flaps(environment.snapshot(),
                     {{8, y, own}, {14, 1, own}, {14, 9, own}, {1, 1, other}, {1, 9, other}},
                     {{0, 1, 2}, {0, 3, 4}});
        ASSERT_TRUE(flaps.lift(1, 3)) << "one flap rests on the membranes";
        const bool is_blocked = flaps.move(0, {14.5, y, 1}).has_value();
        EXPECT_TRUE(is_blocked || own == other) << "the other one is on their other side";
        if (is_blocked) continue;
        EXPECT_FALSE(flaps.lift(own > 1 ? 0.875 : 1.125)) << "through them";
        EXPECT_TRUE(flaps.lift(own > 1 ? 1.125 : 0.875)) << "off them";
      }
}

// A corner comes to the line, in the plane of one of the two walls: the edge at it prefers a fixed side of
// that wall, which may be out of the quarter in which the face stays. It passes with the face.
TEST(PinchedBodies, AnEdgePassesWallsWithItsFace) {
  const auto room = with_walls({below, behind});
  for (const bool is_upright : {false, true})
    for (const Quarter& q : quarters) {
      SCOPED_TRACE(testing::Message() << is_upright << " " << q.y << " " << q.z);
      const Point<3> level = at(is_upright ? 7.5 : 9, 4 * q.y, 0),
                     upright = at(is_upright ? 9 : 7.5, 0, 5 * q.z);
      Moving face(room.snapshot(), {ridge_start, level, upright}, {{0, 1, 2}});
      EXPECT_FALSE(face.move(is_upright ? 2 : 1, ridge_target));
    }
}

// A wall stands on the ridge of a membrane, or hangs from it. A flap below the membrane and one before that
// wall can move on in the one case, and not in the other one.
TEST(PinchedBodies, AWallOnTheRidgeOfAMembranePartsItsSides) {
  for (const bool hangs : {false, true}) {
    const auto room = with_walls({behind, hangs ? below : above});
    Moving flaps(room.snapshot(),
                 {at(6, 0, -0.5), at(10, -2, -0.5), at(10, -0.25, -0.5), at(7.5, 3, 4), at(7.5, 4, 3)},
                 {{0, 1, 2}, {0, 3, 4}});
    ASSERT_TRUE(flaps.lift(6, 3));
    EXPECT_EQ(flaps.move(0, ridge_target).has_value(), hangs);
  }
}

}  // namespace
}  // namespace cellwalk::test
