// SPDX-License-Identifier: LGPL-3.0-or-later
// What lies on the rim of a wall, or is passed by it, takes the side that its edges need, whatever cell it is
// registered in: by hand.
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "oracle/seed.h"
#include "reshape/dimensions.h"
#include "reshape/octahedron.h"
#include "reshape/star_scene.h"

namespace cellwalk {
namespace {

using test::at;

template <class Dimension>
class RimSides : public testing::Test {};
TYPED_TEST_SUITE(RimSides, test::Dimensions, test::Name_of_dimension);

/// Four triangles around point 0; a wall from there to the left ends there.
template <int D>
Cell_soup<D> tip_of_four() {
  test::Flat_soup<D> flat{{0, 0}, {4, 0}, {0, 4}, {-4, 0}, {0, -4}};
  flat.add_fan(4);
  flat.add_wall(0, 3);
  return flat.soup;
}

/// Adds an edge from the tip to a place above or below the wall. Its first vertex came from another place: it
/// keeps a cell that is there.
template <int D>
void add_edge_at_tip(test::Star_scene<D>& scene, const Point<D>& start, double height) {
  Body<D>& body = scene.add_body({start, at<D>(1, 0.25, 0.125)});
  Body_counts counts;
  EXPECT_FALSE(body.move_vertex(0, at<D>(0, 0), {}, counts));
  EXPECT_FALSE(body.move_vertex(1, at<D>(-1, height, 0.125), {}, counts));
}

TYPED_TEST(RimSides, AVertexOnTheRimGoesToTheSideOfItsEdge) {
  constexpr int D = TypeParam::value;
  for (const Point<D>& start : {at<D>(0.5, 1), at<D>(-0.5, 1), at<D>(-0.5, -1), at<D>(0.5, -1)})
    for (const double height : {1.0, -1.0}) {
      test::Star_scene<D> scene(tip_of_four<D>());
      add_edge_at_tip(scene, start, height);
      EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached) << start[0] << " " << start[1] << " " << height;
      scene.expect_hit(at<D>(1, 0.125 * height), 0, 1);
      EXPECT_EQ(scene.end_of(at<D>(1, -0.125 * height)), Move_end::reached);
    }
}

TYPED_TEST(RimSides, EachBodyTakesItsOwn) {
  constexpr int D = TypeParam::value;
  for (const Point<D>& start : {at<D>(0.5, 1), at<D>(-0.5, -1)}) {
    test::Star_scene<D> scene(tip_of_four<D>());
    for (const double height : {1.0, -1.0}) {
      add_edge_at_tip(scene, start, height);
      scene.add_body({at<D>(0.5, 0), at<D>(-1, height, 0.125)});
    }
    EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached);
  }
}

/// One body, of which some parts go above the wall and others below it.
TYPED_TEST(RimSides, EachVertexOfABodyTakesItsOwn) {
  constexpr int D = TypeParam::value;
  // Bits of `above` say which of the edges end above the wall.
  for (std::uint32_t above = 0; above < 16; ++above) {
    test::Star_scene<D> scene(tip_of_four<D>());
    Body_soup<D> soup;
    for (std::uint32_t e = 0; e < 4; ++e) {
      const double height = above >> e & 1 ? 1.0 : -1.0;
      soup.points.push_back(at<D>(0.125 * e, 0));
      soup.points.push_back(at<D>(-1 + 0.125 * e, height, 0.125));
      soup.edges.push_back({2 * e, 2 * e + 1});
    }
    scene.bodies.push_back(std::make_unique<Body<D>>(scene.snapshot, Locator<D>(scene.snapshot), soup));
    EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached) << above;
    // Now those above it are in its way up, and the others in its way down.
    if (above != 0) scene.expect_hit(at<D>(1, 0.125), 0, 1);
    if (above != 15) scene.expect_hit(at<D>(1, -0.125), 0, 1);
  }
}

/// Edges in the way of the rim, each from one place of it to the next or to a place above or below the wall.
template <int D>
std::unique_ptr<Body<D>> edges_in_the_way(const test::Star_scene<D>& scene, std::uint32_t count,
                                          const std::vector<std::array<std::uint32_t, 2>>& joined,
                                          const std::vector<bool>& is_above) {
  Body_soup<D> soup;
  soup.edges = joined;
  for (std::uint32_t k = 0; k < count; ++k) soup.points.push_back(at<D>(0.75 * k / 512, 0));
  for (std::uint32_t k = 0; k < is_above.size(); ++k) {
    soup.edges.push_back({k, count + k});
    soup.points.push_back(at<D>(-1 + 0.125 * (k % 8), is_above[k] ? 1 : -1, 0.125));
  }
  std::ranges::sort(soup.edges);
  soup.edges.erase(std::unique(soup.edges.begin(), soup.edges.end()), soup.edges.end());
  return std::make_unique<Body<D>>(scene.snapshot, Locator<D>(scene.snapshot), soup);
}

/// The sides agree if no two places that edges join have edges to different sides of the wall.
TYPED_TEST(RimSides, JoinedVerticesTakeTheSideOfAllTheirEdges) {
  constexpr int D = TypeParam::value;
  Random random(oracle::reseeded(20'261'130));
  int free = 0, blocked = 0;
  constexpr int bodies = D == 2 ? 60 : 20;
  for (int k = 0; k < bodies; ++k) {
    const auto count = static_cast<std::uint32_t>(2 + random.below(13));
    std::vector<std::array<std::uint32_t, 2>> joined;
    std::vector<std::uint32_t> part(count);
    std::iota(part.begin(), part.end(), 0u);
    for (std::size_t e = random.below(count); e > 0; --e) {
      const auto u = static_cast<std::uint32_t>(random.below(count)),
                 v = static_cast<std::uint32_t>(random.below(count));
      if (u == v) continue;
      joined.push_back({std::min(u, v), std::max(u, v)});
      std::ranges::replace(part, std::uint32_t{part[u]}, std::uint32_t{part[v]});
    }
    // Mostly the places of one part have their edges on one side.
    std::vector<bool> of_part, is_above;
    for (std::uint32_t v = 0; v < count; ++v) of_part.push_back(random.below(2) == 0);
    bool agrees = true;
    for (std::uint32_t v = 0; v < count; ++v) {
      is_above.push_back(of_part[part[v]] != (random.below(2 * count) == 0));
      for (std::uint32_t u = 0; u < v; ++u)
        agrees = agrees && (part[u] != part[v] || is_above[u] == is_above[v]);
    }
    test::Star_scene<D> scene(tip_of_four<D>());
    scene.bodies.push_back(edges_in_the_way(scene, count, joined, is_above));
    ASSERT_EQ(scene.end_of(at<D>(1, 0)) == Move_end::reached, agrees) << k;
    ++(agrees ? free : blocked);
  }
  EXPECT_GT(free, bodies / 4);
  EXPECT_GT(blocked, 0);
}

/// The first and the last place are joined, and both need the second side; one between needs the first. What
/// the others take does not matter to them.
TYPED_TEST(RimSides, ChoicesThatDoNotMatterAreNotTried) {
  constexpr int D = TypeParam::value;
  for (const bool is_above : {false, true}) {
    constexpr std::uint32_t count = 24;
    test::Star_scene<D> scene(tip_of_four<D>());
    Body_soup<D> soup;
    for (std::uint32_t k = 0; k < count; ++k) soup.points.push_back(at<D>(0.03125 * k, 0));
    soup.points.push_back(at<D>(-1, is_above ? 1 : -1, 0.125));
    soup.points.push_back(at<D>(-1, is_above ? -1 : 1, 0.125));
    soup.edges = {{0, count - 1}, {1, count + 1}, {count - 1, count}};
    scene.bodies.push_back(std::make_unique<Body<D>>(scene.snapshot, Locator<D>(scene.snapshot), soup));
    EXPECT_EQ(scene.end_of(at<D>(1, 0)), Move_end::reached) << is_above;
  }
}

/// Only so many combinations of sides are tried: a body that could yield blocks the move then.
TEST(RimSides, ABodyOfTooManyChoicesBlocksTheMove) {
  for (const std::uint32_t count : {100u, 516u}) {
    test::Star_scene<2> scene(tip_of_four<2>());
    std::vector<bool> is_above;
    for (std::uint32_t k = 0; k < count; ++k) is_above.push_back(k % 2 == 0);
    scene.bodies.push_back(edges_in_the_way(scene, count, {}, is_above));
    const bool is_free = count == 100;
    double time = -1;
    for (int tries = 0; tries < 2; ++tries) {
      Reshaping<2> reshaping(scene.environment, scene.residents(), {.at_contact = At_contact::hold});
      const Vertex_result<2> result = reshaping.move(0, {1, 0});
      EXPECT_EQ(result.end == Move_end::reached, is_free) << count;
      ASSERT_EQ(result.hit.has_value(), !is_free);
      if (!is_free && tries > 0) {
        EXPECT_EQ(result.hit->time, time);
      }
      if (!is_free) time = result.hit->time;
      reshaping.finish();
      EXPECT_EQ(scene.snapshot.point(0), (Point<2>{is_free ? 1.0 : 0.0, 0}));
      EXPECT_NO_THROW(scene.bodies.front()->validate());
    }
  }
}

TYPED_TEST(RimSides, AnEdgeAroundTheRimIsInItsWay) {
  constexpr int D = TypeParam::value;
  test::Star_scene<D> scene(tip_of_four<D>());
  Body<D>& body = scene.add_body({at<D>(-1, 1), at<D>(0.5, 0.25), at<D>(-1, -1)});
  Body_counts counts;
  EXPECT_FALSE(body.move_vertex(1, at<D>(0, 0), {}, counts));
  scene.expect_hit(at<D>(1, 0), 0, 1);
}

/// Walls part what is below point 0 into three, and what is above it into two. The edge is above it, where
/// two facets without walls meet: it is in both cells, and each end keeps that in which it came.
TEST(RimSides, BothEndsOfAnEdgeTakeTheSameSideWhateverTheirCells) {
  constexpr double far = 0.5;
  for (const double y : {far, -far})
    for (const double first : {far, -far})
      for (const double second : {far, -far}) {
        test::Star_scene<3> scene(test::octahedron({{0, 1, 5}, {0, 1, 6}, {0, 2, 5}, {0, 2, 6}, {0, 4, 6}}));
        Body<3>& body = scene.add_body({{first, y, 2}, {second, y, 4}});
        Body_counts counts;
        EXPECT_FALSE(body.move_vertex(0, {0, 0, 2}, {}, counts));
        EXPECT_FALSE(body.move_vertex(1, {0, 0, 4}, {}, counts));
        EXPECT_EQ(scene.end_of({0, 0, 8}), Move_end::reached) << y << " " << first << " " << second;
      }
}

/// One triangle upright in the plane of x and z is a wall. Its corner, point 0, moves in that plane.
Cell_soup<3> flap(const Point<3>& corner) {
  test::Flat_soup<3> flat{{0, 0}, {8, 0}, {0, 8}, {-8, 0}, {0, -8}};
  flat.soup.points[0] = corner;
  flat.add_fan(4);
  for (std::size_t f = 0; f < flat.soup.facet_count(); ++f) {
    const auto loop = flat.soup.facet(f);
    const auto has = [&](std::uint32_t p) { return std::ranges::find(loop, p) != loop.end(); };
    if (has(0) && has(1) && has(flat.pole(0))) flat.soup.impassable[f] = 1;
  }
  return flat.soup;
}

TEST(RimSides, AWallThatCoversAVertexForAWhileIsOnTheSideThatItsEdgeNeeds) {
  for (const double depth : {1.0, -1.0})
    for (const double start : {1.0, -1.0}) {
      test::Star_scene<3> scene(flap({2, 0, -2}));
      Body<3>& body = scene.add_body({{1, start, 1}, {-1, depth, 1}});
      Body_counts counts;
      EXPECT_FALSE(body.move_vertex(0, {1, 0, 1}, {}, counts));
      EXPECT_FALSE(body.move_vertex(1, {1, depth, 1}, {}, counts));
      EXPECT_EQ(scene.end_of({-2, 0, 2}), Move_end::reached) << depth << " " << start;
      EXPECT_EQ(scene.end_of({0, 0, 0}), Move_end::reached) << "it covers the vertex again";
      scene.expect_hit({0, 0.25 * depth, 0}, 0, 1);
      EXPECT_EQ(scene.end_of({0, -0.25 * depth, 0}), Move_end::reached);
    }
}

/// The wall lies in the face, and their corners coincide. The face is on one side, by the edge across the
/// wall; its corner keeps a cell that may be on the other side.
TEST(RimSides, ACornerOnTheRimGoesToTheSideOfItsFace) {
  for (const double depth : {1.0, -1.0}) {
    test::Star_scene<3> scene(flap({0, 0, 0}));
    const Body_soup<3> soup{
        {{0, 0, 0}, {3, depth, -1}, {-1, depth, 3}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    scene.bodies.push_back(std::make_unique<Body<3>>(scene.snapshot, Locator<3>(scene.snapshot), soup));
    Body<3>& body = *scene.bodies.back();
    Body_counts counts;
    const Body_options options{.sweep = {.sweep = Sweep::faces}};
    EXPECT_FALSE(body.move_vertex(1, {3, 0, -1}, options, counts));
    EXPECT_FALSE(body.move_vertex(2, {-1, 0, 3}, options, counts));
    EXPECT_EQ(scene.end_of({-1, 0, -1}), Move_end::reached) << depth;
    scene.expect_hit({-1, 0.25 * depth, -1}, 0, 1);
    EXPECT_EQ(scene.end_of({-1, -0.25 * depth, -1}), Move_end::reached);
  }
}

}  // namespace
}  // namespace cellwalk
