// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces that walls touch: resting ones, and walls that land on them. A membrane of the six walls around one
// vertex floats in a grid, strictly inside a large face.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reshape/dimensions.h"
#include "reshape/grids.h"

namespace cellwalk {
namespace {

using test::hold;

/// A floating membrane at height 3 around the vertex at (3, 3, 3), which can be raised or lowered.
struct Tent {
  explicit Tent(double height = 3) : environment(test::simplex_grid<3>(8)) {
    vertex = test::point_at<3>(environment, {3, 3, 3});
    const Snapshot<3>& snapshot = environment.snapshot();
    for (const Cell c : environment.cells_around(vertex))
      for (std::size_t i = 0; i < 4; ++i) {
        const Half_facet f = Snapshot<3>::half_facet(c, i);
        bool is_level = true, has_vertex = false;
        for (const std::uint32_t v : snapshot.loop(f)) {
          is_level &= snapshot.point(v)[2] == 3;
          has_vertex |= v == vertex;
        }
        if (is_level && has_vertex) environment.set_impassable(f, true);
      }
    if (height != 3) place(height);
  }
  void place(double height) {
    Reshaping<3> reshaping(environment, {}, hold);
    EXPECT_EQ(reshaping.move(vertex, {3, 3, height}).end, Move_end::reached);
  }
  Body<3> face(const std::vector<Point<3>>& corners) const {
    return {environment.snapshot(),
            Locator<3>(environment.snapshot()),
            {corners, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}}};
  }
  Body<3> large_face(double height = 3) const {
    return face({{0.5, 0.5, height}, {7.75, 0.5, height}, {0.5, 7.75, height}});
  }
  Vertex_result<3> move(Body<3>& body, const Point<3>& target) {
    Reshaping<3> reshaping(environment, {{&body}, {}}, hold);
    auto result = reshaping.move(vertex, target);
    reshaping.finish();
    EXPECT_NO_THROW(body.validate());
    EXPECT_NO_THROW(environment.certify());
    return result;
  }

  Environment<3> environment;
  std::uint32_t vertex = 0;
};

TEST(RestingFaces, AMembraneThatLandsOnAFaceLeavesItOnItsSide) {
  // The membrane comes from above or below, and no edge of the face is near.
  for (const double side : {1.0, -1.0}) {
    Tent tent(3 + 0.5 * side);
    Body<3> body = tent.large_face();
    EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached) << "it lands";
    const auto through = tent.move(body, {3, 3, 3 - 0.5 * side});
    ASSERT_EQ(through.end, Move_end::contact) << "it must not pass";
    EXPECT_EQ(through.hit->exact_time(), Exact_time());
    EXPECT_EQ(through.hit->resident.feature, Body_feature::face);
    EXPECT_EQ(tent.move(body, {3, 3, 3 + 0.5 * side}).end, Move_end::reached) << "back where it came from";
    EXPECT_EQ(tent.move(body, {3, 3, 3 - 0.5 * side}).end, Move_end::contact) << "now it comes from there";
  }
}

TEST(RestingFaces, ABodyKnowsTheSideOnWhichAMembraneLanded) {
  const Body_options faces{.sweep = {.sweep = Sweep::faces}};
  Body_counts counts;
  for (const double side : {1.0, -1.0}) {
    Tent tent(3 + 0.5 * side);
    Body<3> body = tent.large_face();
    EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached);
    const auto met = body.move_vertex(0, {0.5, 0.5, 3 + 0.25 * side}, faces, counts);
    ASSERT_TRUE(met.has_value()) << "the membrane is there";
    EXPECT_EQ(met->body, Body_feature::face);
    EXPECT_FALSE(body.move_vertex(0, {0.5, 0.5, 3 - 0.25 * side}, faces, counts)) << "away from it";
  }
}

TEST(RestingFaces, WallsThatMoveInThePlaneKeepTheirSide) {
  for (const double side : {1.0, -1.0}) {
    Tent tent(3 + 0.5 * side);
    Body<3> body = tent.large_face();
    EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached);
    for (const Point<3>& x : {Point<3>{3.25, 3.125, 3}, {2.75, 3, 3}, {3, 3, 3}})
      EXPECT_EQ(tent.move(body, x).end, Move_end::reached) << "in its plane";
    EXPECT_EQ(tent.move(body, {3, 3, 3 - 0.125 * side}).end, Move_end::contact);
    EXPECT_EQ(tent.move(body, {3, 3, 3 + 0.125 * side}).end, Move_end::reached);
  }
}

TEST(RestingFaces, AWallMayLandInAnotherPlaceThanItLeft) {
  Tent tent(3.5);
  Body<3> body = tent.large_face();
  EXPECT_EQ(tent.move(body, {3.25, 3, 3}).end, Move_end::reached);
  EXPECT_EQ(tent.move(body, {3, 3.125, 3.25}).end, Move_end::reached);
  EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached);
  EXPECT_EQ(tent.move(body, {3.25, 3, 2.875}).end, Move_end::contact);
}

TEST(RestingFaces, AFaceOnOneSideOfAWallThatIsAlsoTouchedFromTheOtherKeepsBoth) {
  Tent tent(3.5);
  Body<3> below = tent.large_face();
  tent.move(below, {3, 3, 3});
  // Its edges are strictly inside the membrane, from above.
  Body<3> above = tent.face({{2.75, 2.75, 3}, {3.5, 3.25, 3}, {3.125, 3.5, 3}});
  Reshaping<3> reshaping(tent.environment, {{&below, &above}, {}}, hold);
  EXPECT_NE(reshaping.move(tent.vertex, {3, 3, 3.25}).end, Move_end::reached);
  EXPECT_NE(reshaping.move(tent.vertex, {3, 3, 2.75}).end, Move_end::reached);
}

TEST(RestingFaces, AnEdgeThatAWallReachesTakesTheSideOfItsFace) {
  // The membrane grows in its plane beyond an edge of a face that it landed on.
  for (const double side : {1.0, -1.0}) {
    Tent tent(3 + 0.5 * side);
    Body<3> body = tent.face({{1.5, 0.5, 3}, {1.5, 7.75, 3}, {7.75, 0.5, 3}});
    EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached);
    const std::uint32_t corner = test::point_at<3>(tent.environment, {2, 3, 3});
    {
      Reshaping<3> reshaping(tent.environment, {{&body}, {}}, hold);
      EXPECT_EQ(reshaping.move(corner, {1.25, 3, 3}).end, Move_end::reached);
    }
    EXPECT_NO_THROW(body.validate());
    EXPECT_EQ(tent.move(body, {3, 3, 3 - 0.125 * side}).end, Move_end::contact);
    EXPECT_EQ(tent.move(body, {3, 3, 3 + 0.125 * side}).end, Move_end::reached);
    Reshaping<3> reshaping(tent.environment, {{&body}, {}}, hold);
    EXPECT_EQ(reshaping.move(corner, {1.25, 3, 3 - 0.125 * side}).end, Move_end::contact);
    EXPECT_EQ(reshaping.move(corner, {1.25, 3, 3 + 0.125 * side}).end, Move_end::reached);
  }
}

TEST(RestingFaces, AnEdgeKeepsItsSideOfWallsThatMoveInTheirPlane) {
  // Both ends are beyond the membrane, and could be joined on either side of it.
  for (const double side : {1.0, -1.0}) {
    Tent tent(3 + 0.5 * side);
    Body<3> body(tent.environment.snapshot(), Locator<3>(tent.environment.snapshot()),
                 {{{1.25, 2.75, 3}, {4.75, 3.375, 3}}, {{0, 1}}, {}});
    EXPECT_EQ(tent.move(body, {3, 3, 3}).end, Move_end::reached);
    for (const Point<3>& x : {Point<3>{3.125, 3.375, 3}, {2.875, 2.75, 3}, {3, 3, 3}})
      EXPECT_EQ(tent.move(body, x).end, Move_end::reached);
    EXPECT_EQ(tent.move(body, {3, 3, 3 - 0.125 * side}).end, Move_end::contact);
    EXPECT_EQ(tent.move(body, {3, 3, 3 + 0.125 * side}).end, Move_end::reached);
  }
}

/// An octahedron around point 0 that is slit in the half plane of y = 0 and x > 0: points 1 and 7 coincide.
Cell_soup<3> slit_octahedron(const Point<3>& middle) {
  Cell_soup<3> soup;
  soup.points = {middle, {8, 0, 0}, {-8, 0, 0}, {0, 8, 0}, {0, -8, 0}, {0, 0, 8}, {0, 0, -8}, {8, 0, 0}};
  add_tetrahedron(soup, 0, 1, 3, 5);
  add_tetrahedron(soup, 0, 3, 2, 5);
  add_tetrahedron(soup, 0, 2, 4, 5);
  add_tetrahedron(soup, 0, 4, 7, 5);
  add_tetrahedron(soup, 0, 3, 1, 6);
  add_tetrahedron(soup, 0, 2, 3, 6);
  add_tetrahedron(soup, 0, 4, 2, 6);
  add_tetrahedron(soup, 0, 7, 4, 6);
  return soup;
}

/// Both walls of the slit land, one with its only free space where the face is not.
TEST(RestingFaces, ASlitThatLandsOnAFaceLeavesItOnItsSide) {
  for (const double side : {2.0, -2.0}) {
    auto environment =
        Environment<3>::build(slit_octahedron({0, side, 0}), {.duplicates = Duplicate_vertices::keep});
    const std::uint32_t vertex = test::point_at<3>(environment, {0, side, 0});
    Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()),
                 {{{1, 0, 1}, {4, 0, 1}, {1, 0, 4}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}});
    Reshaping<3> reshaping(environment, {{&body}, {}}, hold);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(reshaping.move(vertex, {0, 0, 0}).end, Move_end::reached) << "it lands";
      const auto through = reshaping.move(vertex, {0, -side, 0});
      ASSERT_EQ(through.end, Move_end::contact) << "it must not pass";
      EXPECT_EQ(through.hit->exact_time(), Exact_time());
      EXPECT_EQ(reshaping.move(vertex, {0, side, 0}).end, Move_end::reached) << "back where it came from";
    }
    reshaping.finish();
    EXPECT_NO_THROW(body.validate());
  }
}

/// A tetrahedron that stands on a membrane, across several walls.
TEST(RestingFaces, ABodyAtRestDoesNotHoldAWallThatBeats) {
  Environment<3> environment = test::simplex_grid<3>(4);
  test::add_membrane<3>(environment, 2);
  const std::uint32_t vertex = test::point_at<3>(environment, {2, 2, 2});
  const Locator<3> locator(environment.snapshot());
  Body<3> body(environment.snapshot(), locator,
               {{{1.5, 1.25, 2}, {2.75, 2.5, 2}, {1.25, 2.75, 2}, {2, 2.125, 2.75}},
                {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  Reshaping<3> reshaping(environment, {{&body}, {}}, hold);
  for (int beat = 0; beat < 3; ++beat) {
    for (const double height : {1.75, 1.5, 1.875, 2.0})
      EXPECT_EQ(reshaping.move(vertex, {2, 2, height}).end, Move_end::reached) << height;
    EXPECT_NE(reshaping.move(vertex, {2, 2, 2.25}).end, Move_end::reached) << "the body is there";
  }
  EXPECT_GT(reshaping.counts().rested, 0u);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
}

}  // namespace
}  // namespace cellwalk
