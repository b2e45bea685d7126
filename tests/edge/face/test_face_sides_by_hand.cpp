// SPDX-License-Identifier: LGPL-3.0-or-later
// On which side of the walls in its plane a face lies, where the answer is known: slits, the boundary, edges
// that pass a rim.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include "edge/face_body.h"
#include "edge/relisted.h"
#include "edge/slit_worlds.h"

namespace cellwalk::test {
namespace {

constexpr std::uint32_t width = 5;
constexpr std::uint32_t below = 2 + width * 2, above = below + width * width;

/// Two layers of cubes. What separates the two in the middle, at z = 1:
enum class Middle { membrane, slit, hole };

Cell_soup<3> middle_world(Middle middle) {
  Cell_soup<3> cubes = oracle::make_cubes(width, width, 2);
  if (middle == Middle::membrane) oracle::set_wall(cubes, below, above);
  Slit_maker maker(cubes);
  if (middle == Middle::slit) {
    EXPECT_TRUE(maker.part(cubes.cell_begin[below] + 1, cubes.cell_begin[above], Cut::diagonal, Cut::none));
  }
  const Cell_soup<3> parted = maker.soup();
  if (middle != Middle::hole) return parted;
  Cell_soup<3> result;  // without the cube below
  result.points = parted.points;
  for (std::uint32_t c = 0; c < parted.cell_count(); ++c) {
    if (c == below) continue;
    for (std::size_t f = parted.cell_begin[c]; f < parted.cell_begin[c + 1]; ++f)
      result.add_facet(parted.facet(f));
    result.end_cell();
  }
  return result;
}

Snapshot<3> compiled(const Cell_soup<3>& soup) { return Snapshot<3>::compile(soup, glue(soup)); }

/// A face that has the middle strictly inside it, at a height.
Triangle face_at(double z) {
  return {Point<3>{0.25, 0.25, z}, Point<3>{4.75, 0.25, z}, Point<3>{2.5, 4.75, z}};
}

bool put(Face_body& body, const Snapshot<3>& snapshot, const Triangle& corners) {
  const Locator<3> locator(snapshot);
  return body.place({locator.particle_at(corners[0]).value(), locator.particle_at(corners[1]).value(),
                     locator.particle_at(corners[2]).value()});
}

/// The cells on which the face rests.
std::vector<std::uint32_t> cells_of(const Snapshot<3>& snapshot, const Supporting_walls& supporting_walls) {
  std::vector<std::uint32_t> cells;
  for (const Half_facet supporting_wall : supporting_walls)
    cells.push_back(snapshot.index(snapshot.cell_of(supporting_wall)));
  return cells;
}

TEST(FaceSidesByHand, LandsOnASlitAndLeavesAsItCame) {
  const Snapshot<3> snapshot = compiled(middle_world(Middle::slit));
  for (const double from : {1.5, 0.5}) {
    Face_body body(snapshot);
    ASSERT_TRUE(put(body, snapshot, face_at(from)));
    for (std::size_t k = 0; k < 3; ++k) ASSERT_TRUE(body.move_corner(k, face_at(1)[k]).is_made());
    // One wall from above; from below two, that together coincide with it.
    const std::vector<std::uint32_t> cells =
        from > 1 ? std::vector<std::uint32_t>{above} : std::vector<std::uint32_t>{below, below};
    EXPECT_EQ(cells_of(snapshot, body.supporting_walls()), cells);
    EXPECT_EQ(body.registered().supporting_walls, body.supporting_walls());
    EXPECT_EQ(body.registered().piercing, Half_facet::none);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto through = body.move_corner(k, face_at(2 - from)[k]);
      ASSERT_TRUE(through.is_face_only());
      EXPECT_EQ(through.face.contact->exact_time(), Exact_time());
      EXPECT_EQ(through.face.contact->normal[2], from > 1 ? 1 : -1);
    }
    ASSERT_TRUE(body.move_corner(2, {2.5, 4.875, 1}).is_made());  // in the plane
    EXPECT_EQ(cells_of(snapshot, body.supporting_walls()), cells);
    ASSERT_TRUE(body.move_corner(0, face_at(from)[0]).is_made());
    EXPECT_TRUE(body.supporting_walls().empty());
  }
}

TEST(FaceSidesByHand, AFlatSlitStopsAFaceFromItsOwnSide) {
  const Snapshot<3> snapshot = compiled(middle_world(Middle::slit));
  for (const double from : {1.5, 0.5}) {
    Triangle corners = face_at(1);
    corners[2][2] = from;
    Face_body body(snapshot);
    ASSERT_TRUE(put(body, snapshot, corners));
    const auto outcome = body.move_corner(2, {2.5, 4.75, 2 - from});
    ASSERT_TRUE(outcome.is_face_only());
    EXPECT_EQ(to_rational(outcome.face.contact->exact_time()), Rational(1) / 2);
    EXPECT_EQ(outcome.face.contact->normal[2] > 0, from > 1);
  }
}

TEST(FaceSidesByHand, BehindTheBoundaryIsNothing) {
  const Snapshot<3> snapshot = compiled(middle_world(Middle::hole));
  {
    Face_body body(snapshot);
    ASSERT_TRUE(put(body, snapshot, face_at(1)));
    EXPECT_EQ(cells_of(snapshot, body.supporting_walls()), std::vector<std::uint32_t>{above - 1});
    ASSERT_TRUE(body.move_corner(0, face_at(0.5)[0]).is_face_only());
    ASSERT_TRUE(body.move_corner(0, face_at(1.5)[0]).is_made());
    EXPECT_TRUE(body.supporting_walls().empty());
  }
  {  // on a side of the hole, two edges along its edges
    Face_body body(snapshot);
    ASSERT_TRUE(put(body, snapshot, {Point<3>{3, 3, 1}, Point<3>{3, 2.5, 1}, Point<3>{3, 3, 0.5}}));
    ASSERT_EQ(body.supporting_walls().size(), 1u);
    EXPECT_EQ(body.move_corner(0, {2.5, 3, 1}).face.contact->facet, body.supporting_walls()[0]);
    EXPECT_TRUE(body.move_corner(0, {3.5, 3, 1}).is_made());
  }
}

/// A face on one side of the membrane, the ends of one of its edges on the other. The edge passes the rim in
/// the plane.
TEST(FaceSidesByHand, AnEdgeThatPassesARimTakesNoFaceWithIt) {
  int in_the_way = 0, kept = 0;
  for (const Middle middle : {Middle::membrane, Middle::slit}) {
    const Snapshot<3> snapshot = compiled(middle_world(middle));
    for (const int side : {1, -1}) {
      const auto height = [&](double over) { return 1 + side * over; };
      Triangle corners = face_at(height(-0.25));
      corners[2][2] = height(0.5);
      Face_body body(snapshot);
      ASSERT_TRUE(put(body, snapshot, corners)) << "over the membrane, its first two corners under it";
      for (std::size_t k = 0; k < 3; ++k) ASSERT_TRUE(body.move_corner(k, face_at(1)[k]).is_made());
      const Supporting_walls supporting_walls = body.supporting_walls();
      ASSERT_FALSE(supporting_walls.empty());
      for (const std::uint32_t c : cells_of(snapshot, supporting_walls))
        EXPECT_EQ(c, side > 0 ? above : below);
      const auto outcome = body.move_corner(0, {0.25, 4.75, 1});  // the edge to corner 1 crosses the middle
      if (outcome.is_made()) {
        ++kept;
        for (const std::uint32_t c : cells_of(snapshot, body.supporting_walls()))
          EXPECT_EQ(c, side > 0 ? above : below);
      } else {
        ++in_the_way;
        ASSERT_TRUE(outcome.is_face_only());
        EXPECT_TRUE(outcome.face.is_edge_on_other_side);
        EXPECT_EQ(outcome.face.contact->normal[2], side);
        EXPECT_EQ(body.supporting_walls(), supporting_walls);
      }
      EXPECT_FALSE(body.move_corner(2, {2.5, 4.75, height(-0.5)}).is_made());
      EXPECT_EQ(body.registered().piercing, Half_facet::none);
    }
  }
  EXPECT_GE(in_the_way, 2);
  EXPECT_EQ(in_the_way + kept, 4);
}

/// Turned in all ways, and listed in any order: where any side will do, it is the one towards (e, e^2, e^3).
TEST(FaceSidesByHand, ASideThatNothingSaysIsOneOfTheGeometry) {
  for (const Middle middle : {Middle::membrane, Middle::slit}) {
    const Cell_soup<3> world = middle_world(middle);
    for (std::size_t turn = 0; turn < 24; ++turn) {
      const std::size_t axis = turn % 3;  // of z
      const double flip_x = turn / 3 % 2 == 0 ? 1 : -1, flip_y = turn / 6 % 2 == 0 ? 1 : -1;
      const auto turned = [&](const Point<3>& x) {
        Point<3> y;
        y[(axis + 1) % 3] = turn < 12 ? flip_x * x[0] : -flip_x * x[1];
        y[(axis + 2) % 3] = turn < 12 ? flip_y * x[1] : flip_y * x[0];
        y[axis] = flip_x * flip_y * x[2];
        return y;
      };
      Cell_soup<3> soup = world;
      for (Point<3>& x : soup.points) x = turned(x);
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const Relisted<3> other = relisted(soup, seed);
        const Snapshot<3> snapshot = compiled(other.soup);
        Triangle corners = face_at(1);
        for (Point<3>& x : corners) x = turned(x);
        if (seed % 2 == 1) std::swap(corners[0], corners[1]);
        Face_body body(snapshot);
        ASSERT_TRUE(put(body, snapshot, corners)) << turn;
        ASSERT_FALSE(body.supporting_walls().empty());
        const std::uint32_t up = flip_x * flip_y > 0 ? above : below;
        for (const std::uint32_t c : cells_of(snapshot, body.supporting_walls()))
          EXPECT_EQ(c, other.new_cell[up]) << turn;
      }
    }
  }
}

}  // namespace
}  // namespace cellwalk::test
