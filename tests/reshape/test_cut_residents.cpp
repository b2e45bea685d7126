// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies and particles in the free cells at tissue that is cut: they stay where they are, and on their sides.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "oracle/seed.h"
#include "reshape/tissue_block.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

template <int D>
void expect_valid(const Body<D>& body, const std::vector<Point<D>>& positions) {
  EXPECT_NO_THROW(body.validate());
  EXPECT_TRUE(std::ranges::equal(body.positions(), positions));
}

/// A face that rests on the boundary of the environment, where an edge of that is split.
TEST(CutResidents, AFaceRestsOnTheBoundary) {
  for (const double level : {0.0, 4.0}) {
    auto environment = test::tissue<3>(4, 2, 0);
    const Body_soup<3> soup{
        {{1.3, level, 2.25}, {2.9, level, 2.25}, {2.2, level, 3.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()), soup);
    Reshaping<3> reshaping(environment, {{&body}, {}});
    const Cut_report report =
        reshaping.cut(test::blade<3>({{2.4, -1, 3}, {2.4, 5, 3}, {2.4, 5, -1}, {2.4, -1, -1}}));
    EXPECT_GT(report.split, 5u);
    EXPECT_GT(report.refused(), 0u) << "that on which it rests";
    reshaping.finish();
    EXPECT_NO_THROW(environment.certify());
    expect_valid(body, soup.points);
  }
}

/// The same on the surface of the tissue.
TEST(CutResidents, AFaceRestsOnTheTissue) {
  auto environment = test::tissue<3>(4, 2, 0);
  const Body_soup<3> soup{
      {{1.3, 1.2, 2}, {2.9, 1.3, 2}, {2.2, 2.9, 2}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
  Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()), soup);
  Reshaping<3> reshaping(environment, {{&body}, {}});
  const Cut_report report =
      reshaping.cut(test::blade<3>({{2.4, -1, 3}, {2.4, 5, 3}, {2.4, 5, -1}, {2.4, -1, -1}}));
  EXPECT_GT(report.split, 5u);
  EXPECT_GT(report.refused(), 0u);
  reshaping.finish();
  EXPECT_NO_THROW(environment.certify());
  expect_valid(body, soup.points);
  // It may go up, and not down.
  Body_counts counts;
  EXPECT_FALSE(body.move_vertex(0, {1.3, 1.2, 2.2}, {}, counts));
  EXPECT_TRUE(body.move_vertex(1, {2.9, 1.3, 1.8}, {}, counts));
}

/// Particles and threads on the surface and above it, cut again and again; after each cut they move.
template <int D>
void cut_below_things(std::size_t worlds) {
  std::size_t split = 0, opened = 0, moved = 0;
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const bool is_lattice = seed % 2 == 0;
    constexpr std::uint32_t size = D == 2 ? 8 : 4;
    auto environment = test::tissue<D>(size, 0.5 * size, is_lattice ? 0 : 0.15, seed);
    const Snapshot<D>& snapshot = environment.snapshot();
    const Locator<D> locator(snapshot);
    Random random(oracle::reseeded(seed));
    const auto place = [&] {
      Point<D> x;
      for (double& c : x) c = random.real(0.2, size - 0.2);
      x[D - 1] = random.chance(0.5) ? 0.5 * size : random.real(0.5 * size, size - 0.2);
      if (is_lattice)
        for (double& c : x) c = std::round(4 * c) / 4;
      return x;
    };
    std::vector<Particle<D>> particles;
    std::vector<std::unique_ptr<Body<D>>> bodies;
    for (int tries = 0; tries < 100 && particles.size() < 12; ++tries)
      if (const auto sides = locator.particles_at(place()); !sides.empty()) particles.push_back(sides[0]);
    for (int tries = 0; tries < 100 && bodies.size() < 6; ++tries) {
      Body_soup<D> soup{{place(), place(), place()}, {{0, 1}, {0, 2}, {1, 2}}, {}};
      if (D == 3 && random.chance(0.5)) soup.faces = {{0, 1, 2}};
      try {
        bodies.push_back(std::make_unique<Body<D>>(snapshot, locator, soup));
      } catch (const Error&) {  // across the tissue
      }
    }
    Residents<D> residents{{}, {std::span(particles)}};
    for (const auto& body : bodies) residents.bodies.push_back(body.get());
    for (int turn = 0; turn < 3; ++turn) {
      std::vector<std::vector<Point<D>>> before;
      for (const auto& body : bodies) before.emplace_back(body->positions().begin(), body->positions().end());
      const double x = random.real(1, size - 1);
      std::vector<Point<D>> points;
      if constexpr (D == 2)
        points = {{x, size}, {x + random.real(-1, 1), 1}};
      else
        points = {{x, -1, size}, {x, size + 1, size}, {x + random.real(-1, 1), 0.5 * size, 0.5}};
      Reshaping<D> reshaping(environment, residents);
      const Cut_report report = reshaping.cut(test::blade<D>(points), {.opening = 0.1});
      split += report.split;
      opened += report.opened;
      reshaping.finish();
      ASSERT_NO_THROW(environment.certify());
      for (std::size_t b = 0; b < bodies.size(); ++b) expect_valid(*bodies[b], before[b]);
      for (const Particle<D>& p : particles) {
        EXPECT_TRUE(in_closure(snapshot, p.cell, p.position));
        EXPECT_FALSE(snapshot.is_solid(p.cell));
      }
      Body_counts counts;
      Step_report<D> steps;
      for (const auto& body : bodies) {
        Body_options options;
        if (D == 3 && !body->faces().empty()) options.sweep.sweep = Sweep::faces;
        std::vector<Point<D>> targets(body->positions().begin(), body->positions().end());
        Vector<D> by;
        for (double& c : by) c = is_lattice ? std::round(random.real(-2, 2)) / 4 : random.real(-0.5, 0.5);
        for (Point<D>& target : targets) target = target + by;
        body->step(targets, options, steps, counts);
        moved += body->positions()[0] == targets[0];
        body->refresh(counts);
        EXPECT_NO_THROW(body->validate());
      }
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(split, 5 * worlds);
  EXPECT_GT(opened, worlds);
  EXPECT_GT(moved, worlds);
}

TEST(CutResidents, StayInThePlane) {
  cut_below_things<2>(std::max<std::size_t>(oracle::scaled_count(40), 10));
}
TEST(CutResidents, StayInSpace) { cut_below_things<3>(std::max<std::size_t>(oracle::scaled_count(12), 4)); }

}  // namespace
}  // namespace cellwalk
