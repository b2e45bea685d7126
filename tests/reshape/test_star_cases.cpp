// SPDX-License-Identifier: LGPL-3.0-or-later
// Cases of walls that move which random worlds meet seldom, one test each, in the plane and in space.
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "reshape/dimensions.h"
#include "reshape/grids.h"
#include "reshape/star_scene.h"

namespace cellwalk {
namespace {

using test::at;

template <class Dimension>
class StarCases : public testing::Test {};
TYPED_TEST_SUITE(StarCases, test::Dimensions, test::Name_of_dimension);

/// Four triangles around point 0, of which those below are solid.
template <int D>
Cell_soup<D> half_solid() {
  test::Flat_soup<D> flat{{0, 0}, {4, 0}, {0, 4}, {-4, 0}, {0, -4}};
  flat.add_fan(4);
  for (std::size_t c = flat.soup.cell_count() / 2; c < flat.soup.cell_count(); ++c) flat.soup.solid[c] = 1;
  return flat.soup;
}

TYPED_TEST(StarCases, AVertexInThePlaceOfOneThatMovesIntoSolidIsFree) {
  constexpr int D = TypeParam::value;
  test::Star_scene<D> scene(half_solid<D>());
  scene.add_particle(at<D>(0, 0), at<D>(0, 1));
  scene.add_body({at<D>(0, 0), at<D>(1, 0.5, 0.25)});
  scene.expect_hit(at<D>(0, 1), 0, 1);
  EXPECT_EQ(scene.end_of(at<D>(0, -1)), Move_end::reached);
  EXPECT_EQ(scene.particles[0].dimension, 1) << "between two cells";
  EXPECT_EQ(scene.end_of(at<D>(0.5, 0)), Move_end::reached) << "it arrives in a wall";
  EXPECT_EQ(scene.end_of(at<D>(0.5, 0.125)), Move_end::contact);
  EXPECT_EQ(scene.end_of(at<D>(0, 0)), Move_end::reached) << "back to its place";
  EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached) << "along a wall";
}

/// Two cones over facets in one plane: apexes 0, which moves, below, and 1. Of the facets the middle one is
/// impassable.
template <int D>
Cell_soup<D> facets_in_one_plane() {
  Cell_soup<D> soup;
  if constexpr (D == 2) {
    soup.points = {{0, 0}, {0, 2}, {-3, 1}, {-1, 1}, {1, 1}, {3, 1}};
    for (std::uint32_t k = 2; k < 5; ++k) {
      add_polygon(soup, std::array<std::uint32_t, 3>{0, k + 1, k});
      soup.impassable[soup.facet_count() - 2] = k == 3;
      add_polygon(soup, std::array<std::uint32_t, 3>{1, k, k + 1});
    }
  } else {
    soup.points = {{0, 0, 0},  {0, 0, 2},  {-3, -1, 1}, {-1, -1, 1}, {1, -1, 1},
                   {3, -1, 1}, {-2, 1, 1}, {0, 1, 1},   {2, 1, 1}};
    const std::array<std::array<std::uint32_t, 3>, 5> triangles{
        {{2, 3, 6}, {3, 7, 6}, {3, 4, 7}, {4, 8, 7}, {4, 5, 8}}};
    for (const auto& [a, b, c] : triangles) {
      add_tetrahedron(soup, a, b, c, 1);
      add_tetrahedron(soup, a, c, b, 0);
      for (std::size_t f = soup.facet_count() - 8; f < soup.facet_count(); ++f) {
        const auto loop = soup.facet(f);
        const auto has = [&](std::uint32_t p) { return std::ranges::find(loop, p) != loop.end(); };
        if (has(3) && has(4) && has(7)) soup.impassable[f] = 1;
      }
    }
  }
  return soup;
}

TYPED_TEST(StarCases, AnEdgeAlongLinkFacetsInOnePlaneStaysOnItsSideOfTheWallAmongThem) {
  constexpr int D = TypeParam::value;
  const auto in_plane = [](double x, double height) {
    return D == 2 ? at<D>(x, height) : at<D>(x, 0, height);
  };
  for (const double side : {-1.0, 1.0}) {
    test::Star_scene<D> scene(facets_in_one_plane<D>());
    Body<D>& body = scene.add_body({in_plane(-1.125, 1 + 0.0625 * side), in_plane(1.125, 1 + 0.0625 * side)});
    Body_counts counts;
    for (std::uint32_t v = 0; v < 2; ++v)
      EXPECT_FALSE(body.move_vertex(v, in_plane(v == 0 ? -1.125 : 1.125, 1), {}, counts));
    for (const Point<D>& target : {at<D>(0.25, 0.125), at<D>(-0.5, -0.25), at<D>(0, 0.5), at<D>(0, 0)})
      EXPECT_EQ(scene.end_of(target), Move_end::reached);
    // Each end can go over to the other side beyond the wall, but the edge may not.
    EXPECT_FALSE(body.move_vertex(0, in_plane(-1.125, 1 + 0.0625 * side), {}, counts));
    EXPECT_FALSE(body.move_vertex(0, in_plane(-1.125, 1), {}, counts));
    EXPECT_TRUE(body.move_vertex(0, in_plane(-1.125, 1 - 0.125 * side), {}, counts));
  }
}

TYPED_TEST(StarCases, BothPartsAtAPinchedVertexAreOccupied) {
  constexpr int D = TypeParam::value;
  Cell_soup<D> soup;
  if constexpr (D == 2) {
    soup.points = {{0, 0}, {2, -1}, {2, 1}, {-2, 1}, {-2, -1}};
    add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
    add_polygon(soup, std::array<std::uint32_t, 3>{0, 3, 4});
  } else {
    soup.points = {{0, 0, 0},     {2, -1, -0.5},  {2, 1, -0.5}, {2, 0, 1},
                   {-2, 1, -0.5}, {-2, -1, -0.5}, {-2, 0, 1}};
    add_tetrahedron(soup, 0, 1, 2, 3);
    add_tetrahedron(soup, 0, 4, 5, 6);
  }
  test::Star_scene<D> scene(soup);
  EXPECT_EQ(scene.environment.cells_around(0).size(), 2u);
  scene.add_body({at<D>(-1, 0.125), at<D>(-1.5, -0.125)});
  EXPECT_EQ(scene.end_of(at<D>(0.5, 0)), Move_end::reached) << "away from those on the left";
  EXPECT_EQ(scene.end_of(at<D>(0, 0)), Move_end::reached);
  scene.add_particle(at<D>(0.25, 0), at<D>(1, 0));
  scene.expect_hit(at<D>(0.5, 0), 1, 2);
  EXPECT_EQ(scene.end_of(at<D>(-1.25, 0)), Move_end::contact) << "the body on the left";
  EXPECT_EQ(scene.end_of(at<D>(-0.5, 0)), Move_end::reached);
}

/// Six triangles around point 0; a wall from there to the left ends there.
template <int D>
Cell_soup<D> tip_of_six() {
  test::Flat_soup<D> flat{{0, 0}, {4, 0}, {2, 4}, {-2, 4}, {-4, 0}, {-2, -4}, {2, -4}};
  flat.add_fan(6);
  flat.add_wall(0, 4);
  return flat.soup;
}

TYPED_TEST(StarCases, BothSidesOfATipAreOneSector) {
  constexpr int D = TypeParam::value;
  for (const double z : {0.0, 0.125}) {
    test::Star_scene<D> scene(tip_of_six<D>());
    // From above the wall round its tip to below it.
    scene.add_body({at<D>(-1, 0.5, z), at<D>(0.5, 0.0625, z), at<D>(-1, -0.5, z)});
    EXPECT_EQ(scene.end_of(at<D>(-0.5, 0)), Move_end::reached);
    EXPECT_EQ(scene.end_of(at<D>(0.25, 0.0625)), Move_end::reached);
    EXPECT_EQ(scene.end_of(at<D>(0, 0)), Move_end::reached);
    // The upper edge, before its end. In space it lies in the plane of an edge of two walls, or above it.
    if (D == 3 && z != 0)
      scene.expect_hit(at<D>(0, 1), 40, 189);
    else
      scene.expect_hit(at<D>(0, 1), 5, 24);
    EXPECT_EQ(scene.move(at<D>(1, 0)).end, Move_end::contact) << "its end in front";
    scene.add_particle(at<D>(0.25, 0.5, z), at<D>(1, 1, z));
    EXPECT_EQ(scene.end_of(at<D>(0, 0.015625)), Move_end::reached);
  }
}

TYPED_TEST(StarCases, SlitsOpenAndHoldWhatRestsOnThem) {
  constexpr int D = TypeParam::value;
  // The lower half has points of its own: 0 and 1, 2, 3, the upper one 4, and 5, 6, 7 at the same places.
  test::Flat_soup<D> flat{{0, 0}, {-4, 0}, {0, -4}, {4, 0}, {0, 0}, {4, 0}, {0, 4}, {-4, 0}};
  flat.add(0, 1, 2);
  flat.add(0, 2, 3);
  flat.add(4, 5, 6);
  flat.add(4, 6, 7);
  test::Star_scene<D> scene(flat.soup);
  scene.add_body({at<D>(-1, 0), at<D>(1.5, 0), at<D>(0.5, -1)});
  scene.add_body({at<D>(-1.5, 0), at<D>(1, 0), at<D>(0.25, 1)});
  EXPECT_EQ(scene.end_of(at<D>(0, 0.5)), Move_end::boundary) << "into the other side";
  EXPECT_EQ(scene.end_of(at<D>(0, -0.5), 4), Move_end::boundary);
  scene.expect_hit(at<D>(0, -0.5), 0, 1);
  scene.expect_hit(at<D>(0, 0.5), 0, 1, 4);
  scene.bodies.pop_back();
  EXPECT_EQ(scene.end_of(at<D>(0, 0.5), 4), Move_end::reached) << "it opens";
  EXPECT_EQ(scene.end_of(at<D>(0, 0.25)), Move_end::reached) << "and the other side follows into the gap";
  EXPECT_EQ(scene.end_of(at<D>(0, 0)), Move_end::reached) << "back to the body that rested on it";
  scene.expect_hit(at<D>(0, -0.125), 0, 1);
}

TYPED_TEST(StarCases, AThinSectorBetweenTwoWallsMovesExactly) {
  constexpr int D = TypeParam::value;
  constexpr double width = 0x1p-20;
  test::Flat_soup<D> flat{{0, 0}, {4, 0}, {4, width}, {0, 4}, {-4, 0}, {0, -4}};
  flat.add_fan(5);
  flat.add_wall(0, 1);
  flat.add_wall(0, 2);
  test::Star_scene<D> scene(flat.soup);
  scene.add_particle(at<D>(2, width / 4), at<D>(3, width / 2));
  EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached);
  EXPECT_EQ(scene.end_of(at<D>(0, 0)), Move_end::reached);
  scene.expect_hit(at<D>(1.5, 0), 8, 9);
  EXPECT_EQ(scene.end_of(at<D>(1.25, 0)), Move_end::reached);
  EXPECT_EQ(scene.end_of(at<D>(1.25, width)), Move_end::contact) << "the lower wall";
  EXPECT_EQ(scene.end_of(at<D>(1.25, -width)), Move_end::contact) << "the upper one";
  EXPECT_EQ(scene.end_of(at<D>(-2, width / 8)), Move_end::reached);
}

/// Three spikes around point 0, and cells in the valleys between them.
template <int D>
Cell_soup<D> spikes() {
  test::Flat_soup<D> flat{{0, 0}, {4, -1}, {3, 2}, {0.5, 0.75}, {0, 2}, {-0.5, 0.75}, {-3, 2}, {-4, -1}};
  flat.add_fan(7);
  flat.add(2, 4, 3);
  flat.add(4, 6, 5);
  flat.add_wall(0, 1);
  flat.add_wall(0, 7);
  return flat.soup;
}

TYPED_TEST(StarCases, AChainEntersTheStarThreeTimes) {
  constexpr int D = TypeParam::value;
  for (const double z : {0.0, 0.125}) {
    test::Star_scene<D> scene(spikes<D>());
    Body<D>& body = scene.add_body({at<D>(-2.75, 1.25, z), at<D>(2.75, 1.25, z)});
    for (const Point<D>& target : {at<D>(0.25, 0.125), at<D>(-0.25, -0.125), at<D>(0, 0.25), at<D>(0, 0)})
      EXPECT_EQ(scene.end_of(target), Move_end::reached);
    // In and out of each spike, through facets at the vertex in some.
    EXPECT_GE(body.chain(0).size(), 4u);
    EXPECT_EQ(scene.end_of(at<D>(0, 0.4375)), Move_end::reached);
  }
}

TYPED_TEST(StarCases, BothEndsLieInTheStarAndTheChainLeavesIt) {
  constexpr int D = TypeParam::value;
  for (const double z : {0.0, 0.125}) {
    test::Star_scene<D> scene(spikes<D>());
    // Its ends change their cells when the vertex moves.
    scene.add_body({at<D>(-1.90625, 1.25, z), at<D>(0.03125, 1.25, z), at<D>(1.90625, 1.25, z)});
    scene.add_body({at<D>(-1.84375, 1.25, z), at<D>(-0.03125, 1.25, z)});
    for (const Point<D>& target : {at<D>(0.25, 0.125), at<D>(-0.25, -0.125), at<D>(0.125, 0.25), at<D>(0, 0)})
      EXPECT_EQ(scene.end_of(target), Move_end::reached);
  }
}

TYPED_TEST(StarCases, AVertexThatFellBehindIsFoundInACellThatChanged) {
  constexpr int D = TypeParam::value;
  Environment<D> environment = test::simplex_grid<D>(8);
  const Snapshot<D>& snapshot = environment.snapshot();
  const Locator<D> locator(snapshot);
  Body<D> body(snapshot, locator, {{at<D>(4.125, 4.0625, 4.03125), at<D>(4.5, 4.25, 4.125)}, {{0, 1}}, {}});
  Body_counts counts;
  Step_report<D> report;
  std::vector<Point<D>> targets(body.positions().begin(), body.positions().end());
  for (int i = 0; i < 40; ++i) {
    for (Point<D>& x : targets) x[0] -= 1.0 / 32;
    body.step(targets, {}, report, counts);
  }
  ASSERT_GT(counts.in_region, 20u);
  Point<D> middle;
  middle.fill(4);
  const std::uint32_t first = test::point_at<D>(environment, middle);
  middle[0] = 3;
  const std::uint32_t second = test::point_at<D>(environment, middle);
  {
    // The cells around where it was registered, and around where it is.
    Reshaping<D> reshaping(environment, {{&body}, {}});
    for (const std::uint32_t v : {first, second}) {
      Point<D> target = snapshot.point(v);
      for (double& x : target) x += 0.1875;
      EXPECT_EQ(reshaping.move(v, target).end, Move_end::reached);
    }
  }
  EXPECT_NO_THROW(body.validate());
  const Locator<D> after(snapshot);
  for (std::uint32_t v = 0; v < 2; ++v)
    EXPECT_EQ(body.particles()[v].cell, after.particle_at(body.positions()[v]).value().cell);
}

TYPED_TEST(StarCases, TwoVerticesOfACellMoveInEitherOrder) {
  constexpr int D = TypeParam::value;
  std::vector<std::vector<Point<D>>> places;
  for (const bool reverse : {false, true}) {
    Environment<D> environment = test::simplex_grid<D>(6);
    const Snapshot<D>& snapshot = environment.snapshot();
    Body<D> body(snapshot, Locator<D>(snapshot),
                 {{at<D>(2.5, 2.25, 2.125), at<D>(4.5, 2.25, 2.125)}, {{0, 1}}, {}});
    Point<D> place;
    place.fill(2);
    std::vector<Vertex_move<D>> moves;
    for (int k = 0; k < 2; ++k, place[0] += 1) {
      Point<D> target = place;
      target[0] += 1.25;  // beyond where the second one stands
      moves.push_back({test::point_at<D>(environment, place), target});
    }
    // To make room for the second.
    Point<D> ahead = place;
    ahead[0] += 0.75;
    moves.push_back({test::point_at<D>(environment, place), ahead});
    if (reverse) std::ranges::reverse(moves);
    Reshaping<D> reshaping(environment, {{&body}, {}});
    const Move_report<D> report = reshaping.move(moves);
    reshaping.finish();
    EXPECT_TRUE(report.short_of_target.empty());
    EXPECT_EQ(report.rounds > 1, !reverse) << "in one order the first has to wait";
    EXPECT_NO_THROW(body.validate());
    EXPECT_NO_THROW(environment.certify());
    places.emplace_back(snapshot.points().begin(), snapshot.points().end());
  }
  EXPECT_EQ(places[0], places[1]);
}

TYPED_TEST(StarCases, TheBoundaryGoesNeitherThroughAnotherBranchNorToAnotherPoint) {
  constexpr int D = TypeParam::value;
  Cell_soup<D> soup;
  if constexpr (D == 2) {
    soup.points = {{-4, 1}, {-1, 0}, {1, 0}, {0, 0.5}, {0.125, 8}, {-0.125, 8}};
    add_polygon(soup, std::array<std::uint32_t, 3>{1, 2, 0});
    add_polygon(soup, std::array<std::uint32_t, 3>{3, 4, 5});
  } else {
    soup.points = {{-4, 0, 1},  {-1, -1, 0},      {1, -1, 0},      {0, 1, 0},
                   {0, 0, 0.5}, {0.125, -0.1, 8}, {0.125, 0.1, 8}, {-0.125, 0, 8}};
    add_tetrahedron(soup, 1, 2, 3, 0);
    add_tetrahedron(soup, 5, 7, 6, 4);
  }
  const auto place = [](double x, double height) { return D == 2 ? at<D>(x, height) : at<D>(x, 0, height); };
  test::Star_scene<D> scene(soup);
  const double x = D == 2 ? -0.5 : -0.25;
  scene.add_particle(place(x, 0.125), place(x, 0.0625));
  EXPECT_EQ(scene.end_of(place(4, 1)), Move_end::boundary) << "free at its end only";
  EXPECT_EQ(scene.end_of(place(0, 0.5)), Move_end::boundary) << "the tip of the other one";
  EXPECT_EQ(scene.end_of(place(0, 1)), Move_end::boundary);
  EXPECT_EQ(scene.end_of(place(-2, 1)), Move_end::reached);
  EXPECT_EQ(scene.end_of(place(0, 0.375)), Move_end::reached) << "below it";
  scene.expect_hit(place(0, 0.125), 1, 2);
}

TYPED_TEST(StarCases, APointMayLeaveTheFrameOfThePlanes) {
  constexpr int D = TypeParam::value;
  Environment<D> environment = test::simplex_grid<D>(2);
  const Snapshot<D>& snapshot = environment.snapshot();
  std::vector<Particle<D>> particles = Locator<D>(snapshot).particles_at(at<D>(0.25, 0.375, 0.4375));
  ASSERT_EQ(particles.size(), 1u);
  Point<D> far;
  far.fill(-4096);
  {
    Reshaping<D> reshaping(environment, {{}, {particles}});
    EXPECT_EQ(reshaping.move(0, far).end, Move_end::reached);
  }
  EXPECT_NO_THROW(environment.certify());
  Walk_counts counts;
  EXPECT_EQ(move(snapshot, particles[0], 0.5 * far, counts).status, Walk_status::arrived);
  EXPECT_EQ(move(snapshot, particles[0], 2.0 * far, counts).status, Walk_status::contact);
  {
    Reshaping<D> reshaping(environment, {{}, {particles}}, {.at_contact = At_contact::hold});
    EXPECT_EQ(reshaping.move(0, Point<D>{}).end, Move_end::contact) << "it would pass the particle";
  }
}

TYPED_TEST(StarCases, TheSizeOfTheSceneDoesNotMatter) {
  constexpr int D = TypeParam::value;
  for (const double scale : {1e-6, 1e6, 0x1p-60, 0x1p60}) {
    Cell_soup<D> soup = tip_of_six<D>();
    for (Point<D>& x : soup.points)
      for (double& c : x) c *= scale;
    test::Star_scene<D> scene(soup);
    const auto place = [&](double x, double y, double z = 0) {
      return at<D>(scale * x, scale * y, scale * z);
    };
    scene.add_body({place(-1, 0.5, 0.125), place(0.5, 0.0625, 0.125), place(-1, -0.5, 0.125)});
    EXPECT_EQ(scene.end_of(place(-0.5, 0)), Move_end::reached);
    EXPECT_EQ(scene.end_of(place(0, 0)), Move_end::reached);
    const Vertex_result<D> through = scene.move(place(0, 1));
    ASSERT_EQ(through.end, Move_end::contact);
    EXPECT_NEAR(through.hit->time, D == 2 ? 5.0 / 24 : through.hit->time, 1e-9);
  }
}

}  // namespace
}  // namespace cellwalk
