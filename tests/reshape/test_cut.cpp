// SPDX-License-Identifier: LGPL-3.0-or-later
// Cuts of solid cells along blades, with what stands in the free ones.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "oracle/seed.h"
#include "reshape/tissue_block.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

using test::solid_parts, test::tissue;

template <int D>
Cut_report cut(Environment<D>& environment, const Blade<D>& blade, const Residents<D>& residents = {},
               double opening = 0.02) {
  const Certificate before = environment.certify();
  const std::vector<Point<D>> places = test::free_places(environment.snapshot(), 50, 10);
  Reshaping<D> reshaping(environment, residents);
  const Cut_report report = reshaping.cut(blade, {.opening = opening});
  reshaping.finish();
  const Certificate after = environment.certify();
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
  EXPECT_GE(after.free_volume, before.free_volume * (1 - 1e-12));
  const Locator<D> locator(environment.snapshot());
  for (const Point<D>& x : places) EXPECT_EQ(locator.locate(x).status, Location_status::free);
  EXPECT_EQ(after.vertices, before.vertices + report.points.size());
  return report;
}

template <int D>
void expect_valid(Body<D>& body) {
  Body_counts uncounted;
  body.refresh(uncounted);
  EXPECT_NO_THROW(body.validate());
}

Blade<2> line(std::vector<Point<2>> points) { return blade_along<2>(points); }

TEST(Cut, PartsTissueInThePlane) {
  auto environment = tissue<2>(8, 6);
  const Cut_report report = cut(environment, line({{4.1, 7}, {4.1, -1}}));
  EXPECT_GT(report.edges, 8u);
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_GT(report.snapped, 0u);
  EXPECT_GT(report.facets, 6u);
  EXPECT_EQ(report.held, 0u);
  EXPECT_EQ(report.rim, 1u) << "on the boundary";
  EXPECT_EQ(report.opened, report.facets);
  // The gap is joined to the free space above.
  EXPECT_EQ(environment.certify().components, 1u);
}

TEST(Cut, EndsInsideTissue) {
  auto environment = tissue<2>(8, 6);
  const Cut_report report = cut(environment, line({{4.1, 7}, {4.3, 2.5}}));
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_EQ(report.rim, 1u);
  EXPECT_EQ(report.opened + report.rim, report.facets + 1);
  EXPECT_EQ(environment.certify().components, 1u);
  EXPECT_EQ(solid_parts(environment.snapshot()).size(), 1u);
}

TEST(Cut, FollowsABentBlade) {
  auto environment = tissue<2>(10, 8);
  const double width = 0.4;  // steps much smaller than cells
  std::vector<Point<2>> points;
  for (int k = 0; k <= 40; ++k) {
    const double t = -1 + 2.0 * k / 40;
    points.push_back({5 + 4.4 * t, 9.5 - 6 * (1 - t * t) - width});
  }
  std::reverse(points.begin(), points.end());
  const Cut_report report = cut(environment, line(points));
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_EQ(report.held, 0u);
  EXPECT_EQ(report.rim, 0u) << "both ends lie in free space";
  EXPECT_EQ(solid_parts(environment.snapshot()).size(), 2u) << "a piece is cut out";
}

TEST(Cut, PassesThroughVerticesAndAlongFacets) {
  for (const double x : {4.0, 4.5}) {
    auto environment = tissue<2>(8, 6, 0);
    const Cut_report report = cut(environment, line({{x, 7}, {x, 1}}));
    EXPECT_EQ(report.refused(), 0u) << x;
    EXPECT_EQ(report.held, 0u) << x;
    EXPECT_EQ(report.rim, 1u) << x;
    EXPECT_GE(report.opened, 5u) << x;
    if (x == 4) {
      EXPECT_EQ(report.split, 0u);
    }
  }
}

TEST(Cut, PartsTissueInSpace) {
  auto environment = tissue<3>(5, 4);
  const std::vector<Point<3>> corners{{2.4, 0.6, 4.6}, {2.6, 4.4, 4.6}, {2.6, 4.4, 1.6}, {2.4, 0.6, 1.6}};
  const Cut_report report = cut(environment, blade_along<3>(corners));
  EXPECT_GT(report.edges, 30u);
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_EQ(report.held, 0u);
  EXPECT_GT(report.opened, 10u);
  EXPECT_GT(report.rim, 5u);
  EXPECT_EQ(environment.certify().components, 1u);
}

TEST(Cut, PartsALatticeInSpace) {
  for (const double x : {2.0, 2.5}) {
    auto environment = tissue<3>(5, 4, 0);
    const std::vector<Point<3>> corners{{x, 1, 5}, {x, 4, 5}, {x, 4, 1}, {x, 1, 1}};
    const Cut_report report = cut(environment, blade_along<3>(corners));
    EXPECT_EQ(report.refused(), 0u) << x;
    EXPECT_EQ(report.held, 0u) << x;
    EXPECT_GE(report.opened, 4u) << x;
  }
}

TEST(Cut, OfASweptBladeGoesAround) {
  auto environment = tissue<3>(6, 5);
  std::vector<Point<3>> arc;
  constexpr int steps = 24;
  for (int k = 0; k <= steps; ++k) {
    const double a = 2 * 3.14159265358979 * k / steps;
    arc.push_back({3 + 1.6 * std::cos(a), 3 + 1.6 * std::sin(a), 5.5});
  }
  arc.back() = arc.front();
  const Cut_report report = cut(environment, swept_blade(arc, {0, 0, -3}));
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_GT(report.opened, 30u);
  EXPECT_EQ(solid_parts(environment.snapshot()).size(), 1u) << "it hangs together below";
}

/// What a cut parted goes apart, and a particle falls into the gap.
TEST(Cut, OpensAndLetsAParticleIn) {
  auto environment = tissue<2>(8, 6, 0);
  const Snapshot<2>& snapshot = environment.snapshot();
  Particle<2> particle = *Locator<2>(snapshot).particle_at({4.05, 7});
  Reshaping<2> reshaping(environment, {{}, {std::span(&particle, 1)}});
  const Cut_report report = reshaping.cut(line({{4.1, 7}, {4.1, 1.5}}));
  std::vector<Vertex_move<2>> moves;
  for (const Cut_point& made : report.points)
    if (made.between[0] == made.between[1])
      moves.push_back({made.point, snapshot.point(made.point) + Vector<2>{0.25, 0}});
  EXPECT_GT(moves.size(), 3u);
  EXPECT_TRUE(reshaping.move(moves).short_of_target.empty());
  reshaping.finish();
  environment.certify();
  Walk_counts counts;
  const Point<2> goal{4.05, 3.5};
  EXPECT_EQ(move(snapshot, particle, goal, counts).status, Walk_status::arrived);
  EXPECT_EQ(particle.position, goal);
}

/// A rod that stands on tissue where it is cut stays registered.
TEST(Cut, BodiesStayWhereTheyAre) {
  auto environment = tissue<3>(5, 3);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  Body_soup<3> rod;
  for (int k = 0; k <= 8; ++k) rod.points.push_back({0.6 + 0.5 * k, 2.3, 3.6});
  for (std::uint32_t k = 0; k < 8; ++k) rod.edges.push_back({k, k + 1});
  Body<3> body(snapshot, locator, rod);
  const std::vector<Point<3>> corners{{2.4, -1, 4.6}, {2.6, 6, 4.6}, {2.6, 6, 1.6}, {2.4, -1, 1.6}};
  const Cut_report report = cut(environment, blade_along<3>(corners), {{&body}, {}});
  EXPECT_GT(report.opened, 0u);
  expect_valid(body);
  EXPECT_TRUE(std::ranges::equal(body.positions(), rod.points));
  // It goes on in the environment as it is now.
  Body_counts counts;
  Step_report<3> moved;
  std::vector<Point<3>> targets = rod.points;
  for (Point<3>& x : targets) x[2] -= 0.4;
  EXPECT_NO_THROW(body.step(targets, {}, moved, counts));
  expect_valid(body);
}

TEST(Cut, ABladeMustBeOne) {
  auto environment = tissue<2>(3, 2);
  Reshaping<2> reshaping(environment, {});
  EXPECT_THROW(line({{1, 1}}), Error);
  EXPECT_THROW(line({{1, 1}, {1, std::nan("")}}), Error);
  EXPECT_THROW(reshaping.cut(line({{1, 1}, {1, 1}})), Error);
  EXPECT_THROW(reshaping.cut(line({{1, 1}, {2, 1}}), {.opening = 0}), Error);
  EXPECT_THROW(reshaping.cut({{{1, 1}}, {{0, 3}}}), Error);
  EXPECT_THROW(swept_blade(std::vector<Point<3>>{{1, 1, 1}, {2, 1, 1}}, {0, 0, 0}), Error);
}

/// Random blades, one after the other, among bodies that stand and move: after each, all is certified.
template <int D>
void cut_at_random(std::uint64_t seed, bool lattice, std::size_t& opened, std::size_t& held) {
  constexpr std::uint32_t size = D == 2 ? 9 : 5;
  auto environment = tissue<D>(size, 0.6 * size, lattice ? 0 : 0.15, seed);
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(oracle::reseeded(seed));
  Body_soup<D> rod;
  for (int k = 0; k < 6; ++k) {
    Point<D> x;
    x.fill(0.45 * size);
    x[0] = 0.6 + 0.5 * k;
    x[D - 1] = 0.85 * size;
    rod.points.push_back(x);
  }
  for (std::uint32_t k = 0; k < 5; ++k) rod.edges.push_back({k, k + 1});
  Body<D> body(snapshot, Locator<D>(snapshot), rod);
  for (int turn = 0; turn < 4; ++turn) {
    std::vector<Point<D>> points(D);
    for (Point<D>& x : points)
      for (double& c : x) c = lattice ? std::round(random.real(0, size)) : random.real(-0.5, size + 0.5);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", cut " + std::to_string(turn));
    try {
      const Cut_report report = cut(environment, blade_along<D>(points), {{&body}, {}}, 0.02);
      opened += report.opened;
      held += report.held;
    } catch (const Error& e) {
      ASSERT_EQ(e.code(), Error_code::input) << e.what();  // the points lie in line
    }
    expect_valid(body);
    Body_counts counts;
    Step_report<D> moved;
    std::vector<Point<D>> targets(body.positions().begin(), body.positions().end());
    Vector<D> by;
    for (double& c : by) c = random.real(-0.4, 0.3);
    for (Point<D>& x : targets) x = x + by;
    ASSERT_NO_THROW(body.step(targets, {}, moved, counts));
    expect_valid(body);
  }
}

template <int D>
void cut_many(std::size_t worlds) {
  std::size_t opened = 0, held = 0;
  for (std::uint64_t seed = 0; seed < worlds && !testing::Test::HasFailure(); ++seed)
    cut_at_random<D>(seed, seed % 2 == 0, opened, held);
  std::printf("%dD: %zu vertices parted, %zu held\n", D, opened, held);
  EXPECT_GT(opened, 5 * worlds);
  EXPECT_LT(10 * held, opened);
}

TEST(CutSoak, InThePlane) { cut_many<2>(std::max<std::size_t>(oracle::scaled_count(40), 6)); }
TEST(CutSoak, InSpace) { cut_many<3>(std::max<std::size_t>(oracle::scaled_count(10), 4)); }

}  // namespace
}  // namespace cellwalk
