// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of faces against brute force over all walls in rationals.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "edge/face_trial.h"

namespace cellwalk::test {
namespace {

std::size_t worlds(bool generic) { return oracle::scaled_count((generic ? 1 : 3) * oracle::world_kinds); }

Face_seen sweep(bool generic) {
  Face_seen seen;
  for (std::uint64_t number = 0; number < worlds(generic); ++number) {
    Edge_world<3> w(number, generic);
    sweep_faces(w, generic, seen);
  }
  return seen;
}

/// Few and small walls, large faces: walls come through their insides.
Face_seen sweep_among_spikes() {
  Face_seen seen;
  const std::size_t count = oracle::scaled_count(8);
  for (std::uint64_t number = 0; number < count; ++number) {
    Random random(number);
    Simplex_grid_options<3> grid;
    grid.cells = {4, 4, 4};
    grid.seed = number;
    grid.jitter = 0.15;
    Cell_soup<3> soup = tetrahedral_grid(grid);
    for (auto& wall : soup.impassable) wall = random.below(100) == 0;
    for (std::size_t c = 0; c < soup.cell_count(); ++c) {
      if (random.below(60) != 0) continue;
      soup.solid[c] = 1;
      for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) soup.impassable[f] = 1;
    }
    const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
    const Wall_list<3> walls(snapshot);
    const Locator<3> locator(snapshot);
    const auto anywhere = [&] {
      return Point<3>{random.real(0.3, 3.7), random.real(0.3, 3.7), random.real(0.3, 3.7)};
    };
    for (int k = 0; k < 60; ++k) {
      const auto particle = [&] { return locator.particle_at(anywhere()).value_or(Particle<3>{}); };
      const Particle<3> p = particle(), q = particle(), r = particle();
      if (p.cell == Cell::none || q.cell == Cell::none || r.cell == Cell::none) continue;
      Face_body body(snapshot);
      const bool is_valid = body.place({p, q, r});
      if (body.counts.faces == 0) continue;  // an edge crosses a wall
      check_piercing(walls, body, is_valid, true, seen);
      if (is_valid) {
        Judge judge(snapshot, "spikes, world " + std::to_string(number), walls, body, true, seen);
        for (std::size_t step = 0; step < 9; ++step) {
          Point<3> target = body.corner(step % 3).position;
          for (double& x : target) x = std::clamp(x + random.real(-0.7, 0.7), 0.2, 3.8);
          judge.move(step % 3, target);
        }
      }
      seen.counts += body.counts;
    }
  }
  report("spikes", seen);
  return seen;
}

TEST(Face, NeverMissesASpike) {
  const Face_seen seen = sweep_among_spikes();
  expect_no_fault(seen);
  if (oracle::scaled_count(10) < 10) return;  // too few to meet everything
  EXPECT_GT(seen.registered, 50);
  EXPECT_GT(seen.pierced, 3) << "without a crossed edge";
  EXPECT_GT(seen.face_only, 8) << "the paper's figure 6";
  EXPECT_GT(seen.before_blocked, 3);
}

TEST(Face, NeverMissesAWallInGeneralPosition) {
  const Face_seen seen = sweep(true);
  report("generic", seen);
  expect_no_fault(seen);
  if (worlds(true) < oracle::world_kinds) return;
  EXPECT_GT(seen.sweeps, 200);
  EXPECT_GT(seen.hits, 20);
  EXPECT_GT(seen.before_blocked, 20);
}

TEST(Face, NeverMissesAWallInDegeneratePositions) {
  const Face_seen seen = sweep(false);
  report("degenerate", seen);
  expect_no_fault(seen);
  if (worlds(false) < 3 * oracle::world_kinds) return;
  EXPECT_GT(seen.sweeps, 500);
  EXPECT_GT(seen.hits, 150);
  EXPECT_GT(seen.through_vertex, 40);
  EXPECT_GT(seen.inside_hits, 5);
  EXPECT_GT(seen.at_once, 30);
  EXPECT_GT(seen.face_only, 0);
  EXPECT_GT(seen.flat, 500);
  EXPECT_GT(seen.landed, 5);
  EXPECT_GT(seen.leaves_through, 2);
  EXPECT_GT(seen.chosen, 50);
  EXPECT_GT(seen.pierced, 3);
}

}  // namespace
}  // namespace cellwalk::test
