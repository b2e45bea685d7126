// SPDX-License-Identifier: LGPL-3.0-or-later
// Random moves of an edge among boxes of one size: what the paper's three segments miss, and what each sweep
// costs.
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SWEEP_TRIALS_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SWEEP_TRIALS_H

#include <cellwalk/edge/sweep.h>

#include <array>
#include <cstdint>

namespace cellwalk::small_obstacles {

/// One row: edges of a length, one end of which makes a step of a length, among boxes of a size. Lengths in
/// cubes.
struct Sweep_setting {
  int dimension = 3;
  double step = 0.5;
  double edge_over_step = 1;
  double size_over_step = 1;
  std::uint64_t seed = 1;
  std::uint64_t draws = 0;  ///< moves drawn; those that start in or across a box are not made
};

/// What one sweep did in all moves of a row.
struct Sweep_cost {
  Edge_counts counts;
  double nanoseconds = 0;  ///< a move, with the walk of its end: median of the rounds; 0 if not timed
};

struct Sweep_tally {
  std::uint64_t sweeps = 0;           ///< moves made
  std::uint64_t edge_contacts = 0;    ///< the complete sweep: the edge is blocked first
  std::uint64_t vertex_contacts = 0;  ///< the end that moves is
  std::uint64_t missed = 0;           ///< edge contacts of which three segments see nothing at all
  std::uint64_t late = 0;             ///< edge contacts of which they see only a later one of the moving end
  std::uint64_t false_contacts = 0;   ///< contacts of three segments where the complete sweep is free
  /// Contacts expected by integral geometry, were there one box only for each: see README.md.
  double expected_contacts = 0;
  std::array<Sweep_cost, 2> cost;  ///< three segments, complete
};

inline constexpr std::array sweeps_compared{Sweep::three_segments, Sweep::triangle};

/// Draws the moves of a row and makes each with both sweeps.
/// Cost: some 10 us a move.
Sweep_tally run_sweeps(const Sweep_setting& setting);

/// Times both sweeps on the first of the moves, in turns.
/// \pre rounds > 0
void time_sweeps(const Sweep_setting& setting, int rounds, Sweep_tally& tally);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SWEEP_TRIALS_H
