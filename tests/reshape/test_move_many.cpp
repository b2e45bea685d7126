// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of many vertices in rounds: grids that grow, and a vessel that beats around a body.
#include <cellwalk/generators/vessel.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk {
namespace {

/// Moves that scale the environment from the origin.
template <int D>
std::vector<Vertex_move<D>> scaled(const Snapshot<D>& snapshot, double factor) {
  std::vector<Vertex_move<D>> moves;
  for (std::uint32_t i = 0; i < snapshot.points().size(); ++i)
    moves.push_back({i, factor * snapshot.point(i)});
  return moves;
}

template <int D>
void grow() {
  Environment<D> environment = test::simplex_grid<D>(4);
  const Locator<D> locator(environment.snapshot());
  Body_soup<D> soup;
  soup.points.assign(3, Point<D>{});
  soup.points[0].fill(0.375);
  soup.points[1].fill(1.75);
  soup.points[2].fill(1.5);
  soup.points[2][0] = 0.25;
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  Body<D> body(environment.snapshot(), locator, soup);
  {
    Reshaping<D> reshaping(environment, {{&body}, {}});
    // Farther than a cell: where a vertex goes, another one stands.
    const auto moves = scaled(environment.snapshot(), 1.75);
    const Move_report<D> report = reshaping.move(moves);
    EXPECT_TRUE(report.short_of_target.empty());
    EXPECT_GT(report.rounds, 1u);
    for (const auto& [point, target] : moves) EXPECT_EQ(environment.snapshot().point(point), target);
    EXPECT_GT(reshaping.counts().relinked, 0u);
  }
  EXPECT_NO_THROW(body.validate());
  EXPECT_NO_THROW(environment.certify());
  // In a copy registered anew in the result, each vertex is in the same cell: none lies on a facet.
  const Locator<D> after(environment.snapshot());
  const Body<D> anew(environment.snapshot(), after, soup);
  for (std::uint32_t v = 0; v < 3; ++v)
    if (body.particles()[v].dimension == D) {
      EXPECT_EQ(body.particles()[v].cell, anew.particles()[v].cell);
    }
}

TEST(MoveMany, AGridGrowsAroundABody2) { grow<2>(); }
TEST(MoveMany, AGridGrowsAroundABody3) { grow<3>(); }

TEST(MoveMany, SaysWhatDidNotArrive) {
  Environment<2> environment = test::simplex_grid<2>(4);
  test::add_membrane<2>(environment, 2);
  const std::uint32_t low = test::point_at<2>(environment, {1, 2}),
                      high = test::point_at<2>(environment, {3, 2}),
                      free = test::point_at<2>(environment, {2, 1});
  std::vector<Particle<2>> particles = Locator<2>(environment.snapshot()).particles_at({1.25, 2.25});
  Reshaping<2> reshaping(environment, {{}, {particles}});
  const std::vector<Vertex_move<2>> moves{{low, {1, 2.75}}, {free, {2, 1.25}}, {high, {3, 9}}};
  const Move_report<2> report = reshaping.move(moves);
  ASSERT_EQ(report.short_of_target.size(), 2u);
  EXPECT_EQ(report.short_of_target[0].point, low);
  EXPECT_EQ(report.short_of_target[0].end, Move_end::contact);
  EXPECT_FALSE(report.hits.empty());
  EXPECT_EQ(report.short_of_target[1].point, high);
  EXPECT_EQ(report.short_of_target[1].end, Move_end::cell);
  EXPECT_GT(environment.snapshot().point(high)[1], 2.9) << "almost flat";
  EXPECT_LT(environment.snapshot().point(high)[1], 3);
  EXPECT_EQ(environment.snapshot().point(free), (Point<2>{2, 1.25}));
  EXPECT_LE(report.rounds, 8u);
  for (const auto& result : report.short_of_target)
    EXPECT_EQ(result.position, environment.snapshot().point(result.point));
}

TEST(MoveMany, AVesselBeatsAroundABody) {
  Environment<3> environment =
      Environment<3>::build(branching_vessel({.generations = 1, .cell_size = 0.5}), {.keep_map = false});
  const Snapshot<3>& snapshot = environment.snapshot();
  Body_soup<3> soup;
  for (std::uint32_t i = 0; i < 14; ++i) {
    soup.points.push_back({0.55, 0.1, 1 + 0.2 * i});
    if (i > 0) soup.edges.push_back({i - 1, i});
  }
  Body<3> body(snapshot, Locator<3>(snapshot), soup);
  const std::vector<Point<3>> rest(snapshot.points().begin(), snapshot.points().end());
  std::size_t hits = 0, arrived = 0;
  Body_counts body_counts;
  Step_report<3> steps;
  for (int beat = 1; beat <= 6; ++beat) {
    // The trunk gets narrow and wide again; the body lies half way to its wall.
    const double narrow = beat % 2 ? 0.55 : 1;
    std::vector<Vertex_move<3>> moves;
    for (std::uint32_t i = 0; i < rest.size(); ++i) {
      const double share =
          std::abs(rest[i][2] - 3) < 1.5 ? 1 - (1 - narrow) * (1 - std::abs(rest[i][2] - 3) / 1.5) : 1;
      moves.push_back({i, {share * rest[i][0], share * rest[i][1], rest[i][2]}});
    }
    {
      Reshaping<3> reshaping(environment, {{&body}, {}});
      const Move_report<3> report = reshaping.move(moves);
      hits += report.hits.size();
      arrived += moves.size() - report.short_of_target.size();
      if (narrow == 1) {
        EXPECT_TRUE(report.short_of_target.empty()) << "nothing is stuck once the wall retreats";
      }
    }
    EXPECT_NO_THROW(body.validate());
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (Point<3>& x : targets) x[0] += 1.0 / 64;
    body.step(targets, {}, steps, body_counts);
    body.refresh(body_counts);
    EXPECT_NO_THROW(body.validate());
  }
  EXPECT_NO_THROW(environment.certify());
  EXPECT_GT(hits, 0u);
  EXPECT_GT(arrived, 5 * rest.size());
}

}  // namespace
}  // namespace cellwalk
