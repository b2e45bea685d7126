// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles in a real vessel: none ever leaves it, and every verdict is the oracle's.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "oracle/parity.h"
#include "walk/oracle_trial.h"
#include "walk/walk_judge.h"

namespace cellwalk::oracle {
namespace {

constexpr int moves_per_parity_test = 50;

TEST(WalkAneurysm, NoParticleEverLeavesTheVessel) {
  const auto moves = static_cast<int>(scaled_count(30'000));
  const Surface_soup surface = io::read_surface(CELLWALK_TEST_DATA "/surface/aneurysm3D_1.off");
  const Cell_soup<3> soup = tetrahedralize(surface);
  Build_report report;
  const Environment<3> environment = Environment<3>::build(soup, {}, &report);
  const Snapshot<3>& snapshot = environment.snapshot();
  // The oracle reads what meshing made, so nothing may have been renumbered.
  ASSERT_EQ(report.unused_points + report.merged_points + report.split.cells_split, 0u);
  const Oracle<3> oracle(soup);
  const Locator<3> locator(snapshot);
  Point<3> low = surface.points[0], high = low;
  for (const Point<3>& p : surface.points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  const double size = length(high - low);

  Random random(8);
  Particle<3> particle;
  Point<3> last_contact{};
  bool has_contact = false;
  Walk_counts counts;
  std::array<int, 11> verdicts{};
  int arrived = 0, blocked = 0, to_walls = 0, long_ways = 0, parity_tests = 0, outside = 0;
  for (int k = 0; k < moves; ++k) {
    // A new particle now and then; else it goes on from where it is.
    while (particle.cell == Cell::none || random.below(500) == 0) {
      Point<3> p;
      for (int i = 0; i < 3; ++i) p[i] = random.real(low[i], high[i]);
      particle = locator.particle_at(p).value_or(Particle<3>{});
      has_contact = false;
    }
    // Lengths from 2^-16 to 1/2 of the vessel; after a contact often right to the rounded point of contact.
    Case<3> motion;
    motion.from = particle.position;
    if (has_contact && random.below(2) == 0) {
      motion.to = last_contact;
      ++to_walls;
    } else {
      const double step = size * std::ldexp(0.5, -static_cast<int>(random.below(16)));
      for (int i = 0; i < 3; ++i) motion.to[i] = motion.from[i] + step * random.real(-1, 1);
    }
    motion.start = snapshot.index(particle.cell);
    motion.trace = oracle.trace(motion.from, motion.to);
    motion.truth = judge(motion.trace, motion.start);
    std::vector<Cell> visited;
    Walk_options options;
    options.visited = &visited;
    const Walk_result<3> result = move(snapshot, particle, motion.to, counts, options);
    const Verdict verdict = judge_walk(oracle, snapshot, motion, result, visited);
    ++verdicts[static_cast<int>(verdict)];
    if (verdict != Verdict::right) ADD_FAILURE() << name(verdict) << ": " << describe(motion);
    has_contact = result.status == Walk_status::contact;
    if (has_contact) last_contact = result.contact->point;
    ++(has_contact ? blocked : arrived);
    long_ways += visited.size() > 20;
    if (k % moves_per_parity_test == 0) {
      ++parity_tests;
      outside += !is_inside(surface, particle.position);
    }
  }
  std::cout << snapshot.cell_count() << " cells, " << moves << " moves: " << arrived << " arrived, "
            << blocked << " blocked, " << to_walls << " to a point of contact, " << long_ways
            << " through more than 20 cells, " << counts.crossings << " crossings; " << parity_tests
            << " parity tests, " << outside << " outside\n";
  EXPECT_EQ(verdicts[static_cast<int>(Verdict::right)], moves);
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(parity_tests, (moves + moves_per_parity_test - 1) / moves_per_parity_test);
  EXPECT_GT(arrived, moves / 10);
  EXPECT_GT(blocked, moves / 10);
  EXPECT_GT(to_walls, moves / 20);
  EXPECT_GT(long_ways, moves / 100);
}

}  // namespace
}  // namespace cellwalk::oracle
