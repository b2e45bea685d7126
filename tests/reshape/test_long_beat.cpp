// SPDX-License-Identifier: LGPL-3.0-or-later
// A vessel that beats around a catheter and twenty soft bodies: all is validated after each thousand moves of
// its vertices, and nothing is stuck once the walls retreat.
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

class Beating_vessel {
 public:
  Beating_vessel()
      : environment(Environment<3>::build(branching_vessel({.generations = 1, .cell_size = 0.5}),
                                          {.keep_map = false})),
        snapshot(environment.snapshot()),
        rest_(snapshot.points().begin(), snapshot.points().end()) {
    const Locator<3> locator(snapshot);
    Body_soup<3> catheter;
    for (std::uint32_t i = 0; i < 30; ++i) {
      catheter.points.push_back({0.5, 0.1, 0.5 + 0.125 * i});
      if (i > 0) catheter.edges.push_back({i - 1, i});
    }
    bodies.push_back(std::make_unique<Body<3>>(snapshot, locator, catheter));
    for (int tries = 0; bodies.size() < 21 && tries < 2000; ++tries) try {
        const Point<3> x{random.real(-0.8, 0.8), random.real(-0.8, 0.8), random.real(0.5, 5)};
        const double size = 0.15;
        const Body_soup<3> soft{
            {x, x + Vector<3>{size, 0, 0}, x + Vector<3>{0, size, 0}, x + Vector<3>{0, 0, size}},
            {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
        bodies.push_back(std::make_unique<Body<3>>(snapshot, locator, soft));
      } catch (const Error&) {  // across the wall
      }
  }

  /// All vertices, with a trunk that is narrower by a share at a wave.
  std::vector<Vertex_move<3>> narrowed(double share) const {
    std::vector<Vertex_move<3>> moves;
    for (std::uint32_t i = 0; i < rest_.size(); ++i) {
      const double by = share * std::max(0.0, 1 - std::abs(rest_[i][2] - 3) / 2);
      moves.push_back({i, {(1 - by) * rest_[i][0], (1 - by) * rest_[i][1], rest_[i][2]}});
    }
    return moves;
  }

  /// Moves all in spans of a thousand, after each of which everything is validated. Returns how many fell
  /// short.
  std::size_t move(const std::vector<Vertex_move<3>>& moves, At_contact at_contact) {
    constexpr std::size_t grain = 1000;
    std::size_t fell_short = 0;
    Residents<3> residents;
    for (const auto& body : bodies) residents.bodies.push_back(body.get());
    for (std::size_t first = 0; first < moves.size(); first += grain) {
      {
        Reshaping<3> reshaping(environment, residents, {.at_contact = at_contact});
        const Move_report<3> report =
            reshaping.move(std::span(moves).subspan(first, std::min(grain, moves.size() - first)));
        fell_short += report.short_of_target.size();
        hits += report.hits.size();
        reshaping.finish();
        counts += reshaping.counts();
      }
      for (const auto& body : bodies) EXPECT_NO_THROW(body->validate());
      if (testing::Test::HasFailure()) return fell_short;
    }
    return fell_short;
  }

  /// Bodies keep their shape and drift about.
  void drift() {
    for (const auto& body : bodies) {
      const Vector<3> by{random.real(-0.05, 0.05), random.real(-0.05, 0.05), random.real(-0.05, 0.05)};
      std::vector<Point<3>> targets(body->positions().begin(), body->positions().end());
      for (Point<3>& x : targets) x = x + by;
      Step_report<3> report;
      Body_counts body_counts;
      body->step(targets, {.sweep = {.sweep = body->faces().empty() ? Sweep::triangle : Sweep::faces}},
                 report, body_counts);
      body->refresh(body_counts);
    }
  }

  Environment<3> environment;
  const Snapshot<3>& snapshot;
  Random random{5};
  std::vector<std::unique_ptr<Body<3>>> bodies;
  std::size_t hits = 0;
  Reshape_counts counts;

 private:
  std::vector<Point<3>> rest_;
};

TEST(LongBeat, EverythingStaysValidAndNothingIsStuckOnceWallsRetreat) {
  Beating_vessel vessel;
  ASSERT_EQ(vessel.bodies.size(), 21u);
  const std::size_t beats = std::max<std::size_t>(oracle::scaled_count(3), 1);
  constexpr int steps = 8;
  std::size_t stopped = 0;
  for (std::size_t beat = 0; beat < beats && !testing::Test::HasFailure(); ++beat) {
    const At_contact at_contact = beat % 2 == 0 ? At_contact::stop : At_contact::push;
    for (int k = 1; k < steps; ++k) {
      const double share = 0.5 * std::sin(std::numbers::pi * k / steps);
      stopped += vessel.move(vessel.narrowed(share), at_contact);
      vessel.drift();
    }
    // What spans leave for the next ones arrives with the second try.
    vessel.move(vessel.narrowed(0), at_contact);
    EXPECT_EQ(vessel.move(vessel.narrowed(0), at_contact), 0u) << "stuck after beat " << beat;
    EXPECT_NO_THROW(vessel.environment.certify());
  }
  std::printf(
      "%zu beats of %zu points among 21 bodies: %llu moves made, %zu hits, %zu stopped, %llu pushes\n", beats,
      vessel.snapshot.points().size(), static_cast<unsigned long long>(vessel.counts.made), vessel.hits,
      stopped, static_cast<unsigned long long>(vessel.counts.pushes));
  std::printf("of %llu vertices, edges and faces near at first attempts, certificates decided %llu\n",
              static_cast<unsigned long long>(vessel.counts.near),
              static_cast<unsigned long long>(vessel.counts.certified));
  // The others are what walls meet, which is much here: the vessel narrows to a half.
  EXPECT_GT(vessel.counts.certified, vessel.counts.near / 10 * 9);
  const Reshape_counts& c = vessel.counts;
  EXPECT_LE(c.near - c.certified, c.hits + c.touches + c.left + c.followed + c.rested);
  EXPECT_GT(vessel.counts.made, beats * steps * 300);
  EXPECT_GT(vessel.hits, 0u);
  EXPECT_GT(stopped, 0u);
}

}  // namespace
}  // namespace cellwalk
