// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that touch what they do not pass, one case each: a membrane at height 2 of a grid, around the vertex
// at (2, 2) or (2, 2, 2), and one that ends there.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reshape/dimensions.h"
#include "reshape/grids.h"

namespace cellwalk {
namespace {

using test::hold;

template <int D>
struct Scene {
  /// \param is_tip whether the membrane ends at the vertex: it is there for smaller coordinates only
  explicit Scene(bool is_tip = false) : environment(test::simplex_grid<D>(4)) {
    Point<D> middle;
    middle.fill(2);
    vertex = test::point_at<D>(environment, middle);
    test::add_membrane<D>(environment, 2);
    if (!is_tip) return;
    for (std::size_t i = 0; i < snapshot().cell_slots(); ++i)
      for (std::size_t k = 0; k < snapshot().facet_count(snapshot().cell(i)); ++k) {
        const Half_facet f = Snapshot<D>::half_facet(snapshot().cell(i), k);
        if (snapshot().opposite(f) == Half_facet::none || !snapshot().is_impassable(f)) continue;
        for (const std::uint32_t v : snapshot().loop(f))
          if (snapshot().point(v)[0] > 2) {
            environment.set_impassable(f, false);
            break;
          }
      }
  }
  const Snapshot<D>& snapshot() const { return environment.snapshot(); }

  /// Particles at a place, on both sides if it is in the membrane: first the upper one.
  std::vector<Particle<D>> particles(const Point<D>& x) const {
    std::vector<Particle<D>> result = Locator<D>(snapshot()).particles_at(x);
    const auto height = [&](const Particle<D>& p) {
      double sum = 0;
      for (const std::uint32_t v : snapshot().view(p.cell).vertices) sum += snapshot().point(v)[D - 1];
      return sum;
    };
    std::ranges::sort(result, [&](const auto& a, const auto& b) { return height(a) > height(b); });
    return result;
  }
  Body<D> body(const std::vector<Point<D>>& points, std::vector<std::array<std::uint32_t, 2>> edges) const {
    return {snapshot(), Locator<D>(snapshot()), {points, std::move(edges), {}}};
  }
  Vertex_result<D> move(const Residents<D>& residents, const Point<D>& target) {
    Reshaping<D> reshaping(environment, residents, hold);
    const auto result = reshaping.move(vertex, target);
    reshaping.finish();
    for (const Body<D>* body : residents.bodies) EXPECT_NO_THROW(body->validate());
    return result;
  }
  Vertex_result<D> move(Body<D>& body, const Point<D>& target) { return move({{&body}, {}}, target); }
  Vertex_result<D> move(std::vector<Particle<D>>& p, const Point<D>& target) {
    return move({{}, {p}}, target);
  }

  Environment<D> environment;
  std::uint32_t vertex = 0;
};

template <int D>
void expect_block(const Vertex_result<D>& result, int numerator, int denominator) {
  ASSERT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(numerator), Ring(denominator)));
}

TEST(Touches, AVertexInThePlaceOfTheOneThatMoves) {
  {
    Scene<2> scene;
    auto p = scene.particles({2, 2});
    ASSERT_EQ(p.size(), 2u);
    p.pop_back();
    expect_block(scene.move(p, {2, 2.25}), 0, 1);
    EXPECT_EQ(scene.move(p, {2.25, 2}).end, Move_end::reached) << "along a wall";
    EXPECT_EQ(p[0].dimension, 1);
    EXPECT_EQ(scene.move(p, {2, 2}).end, Move_end::reached);
    EXPECT_EQ(scene.move(p, {1.875, 1.75}).end, Move_end::reached) << "away";
    EXPECT_EQ(p[0].dimension, 2);
    EXPECT_EQ(scene.move(p, {2, 2}).end, Move_end::reached) << "back";
    expect_block(scene.move(p, {2, 2.25}), 0, 1);
  }
  Scene<3> scene;
  auto p = scene.particles({2, 2, 2});
  ASSERT_EQ(p.size(), 2u);
  p.erase(p.begin());
  expect_block(scene.move(p, {2, 2, 1.75}), 0, 1);
  EXPECT_EQ(scene.move(p, {2.25, 2, 2}).end, Move_end::reached) << "along a wall";
  EXPECT_EQ(scene.move(p, {2, 2, 2}).end, Move_end::reached);
  EXPECT_EQ(scene.move(p, {2.125, 2, 2.25}).end, Move_end::reached) << "away";
  expect_block(scene.move(p, {2, 2, 1.75}), 1, 2);
}

TEST(Touches, AVertexPassedByAnEdgeOfTwoWalls) {
  Scene<3> scene;
  // Above the edge from the vertex to (3, 2, 2).
  auto p = scene.particles({2.5, 2, 2.25});
  p.resize(1);
  expect_block(scene.move(p, {2, 2, 2.75}), 2, 3);
  EXPECT_EQ(scene.move(p, {2, 2, 2.5}).end, Move_end::reached) << "touched at the end";
  EXPECT_EQ(p[0].dimension, 1);
  EXPECT_EQ(scene.move(p, {2, 2, 2.25}).end, Move_end::reached);
}

TEST(Touches, AVertexGoesRoundARim) {
  {
    Scene<2> scene(true);
    auto p = scene.particles({2, 2.25});
    p.resize(1);
    EXPECT_EQ(scene.move(p, {2, 2.5}).end, Move_end::reached) << "the tip goes through it";
  }
  Scene<3> scene(true);
  auto p = scene.particles({2, 2, 2.25});
  p.resize(1);
  EXPECT_EQ(scene.move(p, {2, 2, 2.5}).end, Move_end::reached);
  // On the rim between the vertex and (2, 3, 2).
  auto q = scene.particles({2, 2.5, 2.125});
  q.resize(1);
  EXPECT_EQ(scene.move(q, {2, 2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(scene.move(q, {2, 2, 2}).end, Move_end::reached);
}

TEST(Touches, AnEdgeAtRestInAWall) {
  {
    Scene<2> scene;
    Body<2> body = scene.body({{1.25, 2}, {2.5, 2}, {2, 2.5}}, {{0, 1}, {1, 2}});
    expect_block(scene.move(body, {2, 2.25}), 0, 1);
    EXPECT_EQ(scene.move(body, {2.25, 2}).end, Move_end::reached) << "in its own line";
    EXPECT_EQ(scene.move(body, {2, 1.75}).end, Move_end::reached) << "away";
    EXPECT_EQ(scene.move(body, {2, 2}).end, Move_end::reached) << "back";
    expect_block(scene.move(body, {2.25, 2.25}), 0, 1);
  }
  Scene<3> scene;
  Body<3> body = scene.body({{1.25, 1.75, 2}, {2.75, 2.5, 2}, {2, 2, 2.75}}, {{0, 1}, {1, 2}});
  expect_block(scene.move(body, {2, 2, 2.25}), 0, 1);
  EXPECT_EQ(scene.move(body, {2.25, 2.125, 2}).end, Move_end::reached) << "in its own plane, across the edge";
  EXPECT_EQ(scene.move(body, {2, 1.75, 2}).end, Move_end::reached) << "and back, through it";
  EXPECT_EQ(scene.move(body, {2, 2, 1.75}).end, Move_end::reached) << "away: the walls tilt";
  EXPECT_EQ(scene.move(body, {2.125, 2, 2}).end, Move_end::reached) << "back";
  expect_block(scene.move(body, {2, 2, 2.25}), 0, 1);
}

TEST(Touches, AnEdgePassedByTheVertexItself) {
  {
    Scene<2> scene(true);
    Body<2> body = scene.body({{1.75, 2.5}, {2.5, 2}}, {{0, 1}});
    expect_block(scene.move(body, {2, 2.5}), 2, 3);
  }
  // In space the tip may touch an edge with its vertex alone, and the edge goes round it.
  Scene<3> scene(true);
  Body<3> body = scene.body({{2, 1.5, 2.25}, {2.25, 2, 2.25}, {2.5, 2.5, 2.25}}, {{0, 1}, {1, 2}});
  EXPECT_EQ(scene.move(body, {2.25, 2, 2.25}).end, Move_end::reached) << "touched at the end";
  EXPECT_EQ(scene.move(body, {2, 2, 2}).end, Move_end::reached);
}

TEST(Touches, ARimThatGrowsInItsPlaneThroughACrossingEdge) {
  {
    Scene<2> scene(true);
    Body<2> body = scene.body({{2.25, 1.5}, {2.25, 2.5}}, {{0, 1}});
    expect_block(scene.move(body, {2.5, 2}), 1, 2);
    EXPECT_EQ(scene.move(body, {2.25, 2}).end, Move_end::reached) << "it arrives exactly";
    expect_block(scene.move(body, {2.5, 2}), 0, 1);
    EXPECT_EQ(scene.move(body, {2, 2}).end, Move_end::reached);
  }
  Scene<3> scene(true);
  Body<3> body = scene.body({{2.25, 2, 1.5}, {2.25, 2, 2.5}}, {{0, 1}});
  expect_block(scene.move(body, {2.5, 2, 2}), 1, 2);
  EXPECT_EQ(scene.move(body, {2.25, 2, 2}).end, Move_end::reached) << "it arrives exactly";
  expect_block(scene.move(body, {2.375, 2, 2}), 0, 1);
}

TEST(Touches, ARimThatGrowsAlongAnEdge) {
  {
    Scene<2> scene(true);
    Body<2> body = scene.body({{2.25, 2}, {2.75, 2}}, {{0, 1}});
    EXPECT_EQ(scene.move(body, {2.5, 2}).end, Move_end::reached) << "it takes a side";
    const bool is_above = scene.move(body, {2.5, 1.875}).end == Move_end::reached;
    if (is_above) {
      EXPECT_EQ(scene.move(body, {2.5, 2}).end, Move_end::reached);
    }
    expect_block(scene.move(body, {2.5, is_above ? 2.125 : 1.875}), 0, 1);
  }
  Scene<3> scene(true);
  Body<3> body = scene.body({{2.125, 1.875, 2}, {2.25, 2.125, 2}, {2.25, 2, 2.5}}, {{0, 1}, {1, 2}});
  EXPECT_EQ(scene.move(body, {2.5, 2, 2}).end, Move_end::reached);
  expect_block(scene.move(body, {2.5, 2, 2.25}), 0, 1);
  EXPECT_EQ(scene.move(body, {2.5, 2, 1.75}).end, Move_end::reached) << "its other end is above";
}

TEST(Touches, AnEdgeInThePlaneAndInTheLineOfTheWay) {
  {
    Scene<2> scene;
    Body<2> body = scene.body({{2, 2.25}, {2, 2.75}}, {{0, 1}});
    expect_block(scene.move(body, {2, 2.5}), 1, 2);
    EXPECT_EQ(scene.move(body, {2, 2.25}).end, Move_end::reached);
  }
  Scene<3> scene;
  Body<3> line = scene.body({{2, 2, 2.25}, {2, 2, 2.75}}, {{0, 1}});
  expect_block(scene.move(line, {2, 2, 2.5}), 1, 2);
  Body<3> plane = scene.body({{2, 1.5, 2.25}, {2, 2.5, 2.25}}, {{0, 1}});
  expect_block(scene.move({{&plane, &line}, {}}, {2, 2, 2.5}), 1, 2);
  EXPECT_EQ(scene.move({{&line, &plane}, {}}, {2, 2, 2.25}).end, Move_end::reached);
  expect_block(scene.move({{&line, &plane}, {}}, {2, 2, 2.5}), 0, 1);
  EXPECT_EQ(scene.move({{&line, &plane}, {}}, {2, 2, 2}).end, Move_end::reached);
}

TEST(Touches, EdgesOfNoLengthGoRoundTogether) {
  Scene<3> scene(true);
  const Point<3> x{2, 2, 2.25};
  Body<3> body = scene.body({x, x, {2.5, 2, 2.25}}, {{0, 1}, {1, 2}});
  EXPECT_EQ(scene.move(body, {2, 2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(scene.move(body, {2, 2, 2}).end, Move_end::reached);
}

TEST(Touches, AVertexThatMovesArrivesAtAFace) {
  Scene<3> scene;
  Body<3> body(
      scene.snapshot(), Locator<3>(scene.snapshot()),
      {{{1.25, 1.125, 2.25}, {3.5, 1.25, 2.25}, {1.125, 3.5, 2.25}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}});
  EXPECT_EQ(scene.move(body, {2, 2, 2.25}).end, Move_end::reached) << "it touches the face";
  expect_block(scene.move(body, {2, 2, 2.5}), 0, 1);
  EXPECT_EQ(scene.move(body, {2, 2, 2}).end, Move_end::reached);
  expect_block(scene.move(body, {2, 2, 2.5}), 1, 2);
}

}  // namespace
}  // namespace cellwalk
