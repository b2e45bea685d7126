// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge: which moves pass through an edge, by brute force over all triangles and edges, in the rational
// numbers of the tests' oracle, which shares nothing with the library.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_JUDGE_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_JUDGE_H

#include <cstdint>
#include <vector>

#include "narrow.h"
#include "swept_walls.h"

namespace cellwalk::moving_walls {

struct Judgement {
  std::vector<std::uint8_t> blocked;  ///< of each move, 1 if a wall passes through an edge
  /// Moves whose walls pass through an edge on the way to where the recorded position after them is, if that
  /// is not the target.
  std::uint32_t bad_stops = 0;
  std::uint32_t pairs = 0;    ///< of a tetrahedron and an edge whose boxes meet
  std::uint32_t touches = 0;  ///< of these, that meet in no inner point
};

/// Judges all moves of a step.
Judgement judge(const Swept_walls& walls, const Body_edges& edges);

/// True if a wall passes through an edge.
bool passes_by_fractions(const Moving_wall& wall, const Edge& edge, Judgement& counts);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_JUDGE_H
