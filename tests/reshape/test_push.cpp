// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that push what they meet out of their way, and moves that are only asked about.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "reshape/dimensions.h"
#include "reshape/grids.h"
#include "reshape/star_scene.h"
#include "reshape/wall_judge.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

constexpr Reshape_options push{.at_contact = At_contact::push};

/// A grid of 4 x 4 x 4 unit cubes with a membrane at height 2, whose middle vertex moves.
template <int D>
struct Room {
  Room() : environment(test::simplex_grid<D>(4)) {
    test::add_membrane<D>(environment, 2);
    Point<D> middle;
    middle.fill(2);
    vertex = test::point_at<D>(environment, middle);
  }
  const Snapshot<D>& snapshot() const { return environment.snapshot(); }
  /// A place beside the middle plane, so that in 3D what lies there is not met by the vertex itself.
  Point<D> beside(double x, double height) const { return at(x, height, 2.0625); }
  Point<D> at(double x, double height, double y = 2) const {
    if constexpr (D == 2)
      return {x, height};
    else
      return {x, y, height};
  }
  Body<D> body(const std::vector<Point<D>>& points, std::vector<std::array<std::uint32_t, 2>> edges,
               std::vector<std::array<std::uint32_t, 3>> faces = {}) const {
    return Body<D>(snapshot(), Locator<D>(snapshot()), {points, std::move(edges), std::move(faces)});
  }

  Environment<D> environment;
  std::uint32_t vertex = 0;
};

template <class Dimension>
class PushTest : public testing::Test {};
TYPED_TEST_SUITE(PushTest, test::Dimensions, test::Name_of_dimension);

TYPED_TEST(PushTest, AnEdgeIsPushedAsFarAsTheWallNeeds) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  Body<D> body = room.body({room.beside(1.5, 2.125), room.beside(2.5, 2.125)}, {{0, 1}});
  Reshaping<D> reshaping(room.environment, {{&body}, {}}, push);
  const Point<D> target = room.at(2, 2.5);
  const auto result = reshaping.move(room.vertex, target);
  EXPECT_EQ(result.end, Move_end::reached);
  EXPECT_EQ(room.snapshot().point(room.vertex), target);
  EXPECT_FALSE(result.hit.has_value());
  EXPECT_EQ(reshaping.counts().pushes, 1u);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
  for (const Point<D>& x : body.positions()) {
    EXPECT_GT(x[D - 1], D == 2 ? 2.5 : 2.25) << "the wall is below";
    EXPECT_LT(x[D - 1], 2.5 + 1e-12) << "and the edge no further than needed";
  }
  Step_report<D> report;
  Body_counts counts;
  const std::vector<Point<D>> down{room.at(1.5, 1.5), room.at(2.5, 1.5)};
  body.step(down, {}, report, counts);
  EXPECT_FALSE(report.contacts.empty()) << "it is registered above the wall";
}

TYPED_TEST(PushTest, HitsBeforePushesAreReportedWithWeightsOfBothSides) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  Body<D> body = room.body({room.beside(1.75, 2.125), room.beside(2.75, 2.125)}, {{0, 1}});
  Reshaping<D> reshaping(room.environment, {{&body}, {}}, push);
  const std::vector<Vertex_move<D>> moves{{room.vertex, room.at(2, 2.5)}};
  const Move_report<D> report = reshaping.move(moves);
  EXPECT_TRUE(report.short_of_target.empty());
  ASSERT_FALSE(report.hits.empty());
  const Wall_hit<D>& hit = report.hits[0];
  EXPECT_EQ(hit.vertex, room.vertex);
  EXPECT_EQ(hit.kind, D == 2 ? Contact_kind::vertex : Contact_kind::edge);
  if (D == 2) {
    EXPECT_NEAR(hit.time, 0.25, 1e-15);
  }
  double wall_weights = 0;
  for (const double w : hit.weights) wall_weights += w;
  EXPECT_NEAR(wall_weights, 1, 1e-15);
  EXPECT_EQ(hit.resident.feature, Body_feature::edge);
  // The edge is met where the vertex is, or between it and the edge's own height.
  EXPECT_NEAR(hit.resident_weights[0], 0.75, D == 2 ? 1e-15 : 0.1);
  EXPECT_NEAR(hit.resident_weights[0] + hit.resident_weights[1], 1, 1e-15);
  EXPECT_EQ(hit.resident_weights[2], 0);
  EXPECT_GT(hit.normal[D - 1], D == 2 ? 1 - 1e-15 : 0.8) << "across the edge, along the motion";
  EXPECT_EQ(report.hits.size(), reshaping.counts().pushes);
  if constexpr (D == 2) {
    // Where they met, the edge moved by the 0.375 that were left; each end by its weight over 0.625.
    ASSERT_EQ(report.hits.size(), 1u);
    EXPECT_NEAR(body.positions()[0][1], 2.125 + 0.75 / 0.625 * 0.375, 1e-12);
    EXPECT_NEAR(body.positions()[1][1], 2.125 + 0.25 / 0.625 * 0.375, 1e-12);
  }
}

TYPED_TEST(PushTest, WhatIsSqueezedStopsTheWall) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  test::add_membrane<D>(room.environment, 3);
  Body<D> body = room.body({room.beside(1.5, 2.75), room.beside(2.5, 2.75)}, {{0, 1}});
  Reshaping<D> reshaping(room.environment, {{&body}, {}}, push);
  // The ceiling comes down on both sides, so that the ends of the edge get no higher than 2.8.
  for (const double x : {1.0, 3.0}) {
    const std::uint32_t ceiling = test::point_at<D>(room.environment, room.at(x, 3));
    ASSERT_EQ(reshaping.move(ceiling, room.at(x, 2.6)).end, Move_end::reached);
  }
  const auto result = reshaping.move(room.vertex, room.at(2, 2.9765625));
  EXPECT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(reshaping.counts().pushes, 16u);
  EXPECT_GT(result.position[D - 1], 2.74);
  EXPECT_LT(result.position[D - 1], 2.9765625);
  EXPECT_EQ(room.snapshot().point(room.vertex), result.position);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
  EXPECT_NO_THROW(room.environment.certify());
}

TYPED_TEST(PushTest, ParticlesArePushed) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  std::vector<Particle<D>> particles;
  for (const Particle<D>& p : Locator<D>(room.snapshot()).particles_at(room.beside(2.03125, 2.125)))
    particles.push_back(p);
  ASSERT_FALSE(particles.empty());
  Reshaping<D> reshaping(room.environment, {{}, {particles}}, push);
  EXPECT_EQ(reshaping.move(room.vertex, room.at(2, 2.5)).end, Move_end::reached);
  reshaping.finish();
  for (const Particle<D>& p : particles) {
    EXPECT_TRUE(in_closure(room.snapshot(), p.cell, p.position));
    EXPECT_GT(p.position[D - 1], 2.4);
  }
}

TYPED_TEST(PushTest, FirstAttemptsAreCountedOnce) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  Body<D> body = room.body({room.beside(1.5, 2.125), room.beside(2.5, 2.125)}, {{0, 1}});
  Reshaping<D> asking(room.environment, {{&body}, {}}, push);
  ASSERT_EQ(asking.test_move(room.vertex, room.at(2, 2.5)).end, Move_end::contact);
  asking.finish();
  const Reshape_counts asked = asking.counts();
  EXPECT_EQ(asked.near, asked.vertices + asked.edges);
  EXPECT_EQ(asked.certified, asked.same_cell + asked.same_chain + asked.apart);
  EXPECT_LT(asked.certified, asked.near) << "the edge is hit";
  Reshaping<D> pushing(room.environment, {{&body}, {}}, push);
  const std::vector<Vertex_move<D>> moves{{room.vertex, room.at(2, 2.5)}};
  ASSERT_TRUE(pushing.move(moves).short_of_target.empty());
  EXPECT_EQ(pushing.counts().near, asked.near);
  EXPECT_EQ(pushing.counts().certified, asked.certified);
  EXPECT_GT(pushing.counts().vertices + pushing.counts().edges, asked.near) << "it tried again";
}

TYPED_TEST(PushTest, NothingMovesWhereOneOnlyAsks) {
  constexpr int D = TypeParam::value;
  Room<D> room;
  Body<D> body = room.body({room.beside(1.5, 2.125), room.beside(2.5, 2.125)}, {{0, 1}});
  const std::vector<Point<D>> before(body.positions().begin(), body.positions().end());
  Reshaping<D> reshaping(room.environment, {{&body}, {}}, push);
  const Point<D> from = room.snapshot().point(room.vertex);
  const auto free = reshaping.test_move(room.vertex, room.at(2, 2.0625));
  EXPECT_EQ(free.end, Move_end::reached);
  EXPECT_EQ(free.position, room.at(2, 2.0625));
  const auto blocked = reshaping.test_move(room.vertex, room.at(2, 2.5));
  EXPECT_EQ(blocked.end, Move_end::contact);
  ASSERT_TRUE(blocked.hit.has_value());
  EXPECT_GT(blocked.hit->exact_time(), Exact_time());
  EXPECT_EQ(blocked.position, from);
  EXPECT_EQ(reshaping.test_move(room.vertex, room.at(2, 3.5)).end, Move_end::cell);
  EXPECT_EQ(room.snapshot().point(room.vertex), from);
  EXPECT_EQ(reshaping.counts().made, 0u);
  reshaping.finish();
  EXPECT_TRUE(std::ranges::equal(before, body.positions()));
  EXPECT_NO_THROW(body.validate());
  EXPECT_THROW(reshaping.test_move(room.vertex, from), Error);
}

// The union of two cells is convex until the tip between them comes in. An edge that is pushed in one of them
// must not pass that tip.
TYPED_TEST(PushTest, ATipThatCameInBetweenTwoCellsIsNotPassed) {
  constexpr int D = TypeParam::value;
  test::Flat_soup<D> soup({{0, 0.5}, {-4, 0}, {0, -4}, {4, 0}, {0, 6}});
  soup.add_fan(4);
  soup.add_wall(0, 1);
  soup.add_wall(0, 3);
  test::Star_scene<D> scene(soup.soup);
  Body<D>& body = scene.add_body({test::at<D>(-2, -1.5, 0.25), test::at<D>(2, -1.5, 0.25)});
  Reshaping<D> reshaping(scene.environment, scene.residents(), push);
  ASSERT_EQ(reshaping.move(0, test::at<D>(0, -1)).end, Move_end::reached);
  ASSERT_EQ(reshaping.counts().pushes, 0u);
  reshaping.move(2, test::at<D>(0, -1.25));
  EXPECT_GT(reshaping.counts().pushes, 0u);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
  const auto x = body.positions();
  const double share = -x[0][0] / (x[1][0] - x[0][0]);
  EXPECT_LE(x[0][1] + share * (x[1][1] - x[0][1]), D == 2 ? -1 + 1e-12 : -0.96) << "below the tip";
}

TEST(PushFaces, AFaceIsPushedAndKeptFree) {
  Room<3> room;
  Body<3> body = room.body({{1.5, 1.5, 2.25}, {2.75, 1.5, 2.25}, {2, 2.75, 2.25}}, {{0, 1}, {0, 2}, {1, 2}},
                           {{0, 1, 2}});
  Body_options faces;
  faces.sweep.sweep = Sweep::faces;
  Step_report<3> report;
  Body_counts counts;
  std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
  for (Point<3>& x : targets) x[2] -= 0.125;
  body.step(targets, faces, report, counts);
  Reshaping<3> reshaping(room.environment, {{&body}, {}}, push);
  EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2.5}).end, Move_end::reached);
  const auto through = reshaping.test_move(room.vertex, {2, 2, 2.625});
  EXPECT_EQ(through.end, Move_end::contact) << "it is still one whose faces nothing may pierce";
  if (through.hit) {
    EXPECT_EQ(through.hit->resident.feature, Body_feature::face);
  }
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
  double height = 0;
  for (const Point<3>& x : body.positions()) height += x[2] / 3;
  EXPECT_GT(height, 2.4);
}

/// Walls push bodies about; between pushes, the oracle judges what is said of other moves: nothing that was
/// pushed may be missed.
template <int D>
void push_about(bool generic, std::size_t worlds) {
  typename test::Wall_judge<D>::Tally tally;
  Reshape_counts counts;
  for (std::uint64_t number = 0; number < oracle::scaled_count(worlds); ++number) {
    test::Reshape_world<D> world(number, generic);
    world.populate(12, 8);
    test::Wall_judge<D> judge(world, tally);
    for (int phase = 0; phase < 3; ++phase) {
      Reshaping<D> reshaping(world.environment, world.residents(), push);
      for (int i = 0; i < 8; ++i) {
        const std::uint32_t pushing = world.vertex();
        reshaping.move(pushing, world.target(pushing));
        for (int k = 0; k < 2; ++k) {
          const std::uint32_t v = world.vertex();
          judge.judge(reshaping, v, world.target(v), true);
        }
      }
      // What is known of where things are now is the same as if nothing had been pushed.
      std::vector<std::pair<std::uint32_t, Point<D>>> asked;
      std::vector<Vertex_result<D>> answers;
      for (int i = 0; i < 60; ++i) {
        const std::uint32_t v = world.vertex();
        asked.emplace_back(v, world.target(v));
        answers.push_back(reshaping.test_move(v, asked.back().second));
      }
      reshaping.finish();
      counts += reshaping.counts();
      Reshaping<D> again(world.environment, world.residents(), push);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        const Vertex_result<D> answer = again.test_move(asked[i].first, asked[i].second);
        EXPECT_EQ(answer.end, answers[i].end) << world.name();
        EXPECT_EQ(answer.hit.has_value(), answers[i].hit.has_value()) << world.name();
        if (answer.hit && answers[i].hit) {
          EXPECT_EQ(answer.hit->exact_time(), answers[i].hit->exact_time()) << world.name();
        }
      }
      again.finish();
      for (const auto& body : world.bodies) EXPECT_NO_THROW(body->validate()) << world.name();
      for (const Particle<D>& p : world.particles)
        EXPECT_TRUE(in_closure(world.snapshot, p.cell, p.position)) << world.name();
      EXPECT_NO_THROW(world.environment.certify()) << world.name();
    }
    EXPECT_EQ(tally.wrong(), 0) << world.name();
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(counts.pushes, static_cast<std::uint64_t>(tally.moves) / 50);
  EXPECT_GT(tally.contacts, tally.moves / 100);
  testing::Test::RecordProperty("pushes", static_cast<int>(counts.pushes));
  testing::Test::RecordProperty("judged", tally.moves);
}

TEST(PushOracle, Generic2D) { push_about<2>(true, 40); }
TEST(PushOracle, Degenerate2D) { push_about<2>(false, 40); }
TEST(PushOracle, Generic3D) { push_about<3>(true, 20); }
TEST(PushOracle, Degenerate3D) { push_about<3>(false, 20); }

}  // namespace
}  // namespace cellwalk
