// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene of the paper's figure 8, recorded: hexahedra fly through a grid with solid cells.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H

#include <cellwalk/internal/records/trace.h>

#include <array>
#include <cstdint>

namespace cellwalk::figure_8 {

struct Trace_options {
  std::array<std::uint32_t, 3> cells{10, 10, 10};
  /// Up to an eighth: solid cells touch each other nowhere; above: drawn one by one, they may.
  double solid_share = 0.1;
  double body_side = 0.3;  ///< in cells
  double speed = 0.02;     ///< cells a step
  std::uint32_t bodies = 225, steps = 100;
  std::uint64_t seed = 1;
};

/// Makes a trace. Cubes start at random places, turned at random, where their edges are free. In each step
/// the vertices aim at the rigid body nearest to them, moved on and turned a little; a body of which a vertex
/// was held back flies another way. The answers are those of Trace_recorder. Same options, same bytes, on
/// every machine.
/// \throw Error(usage) if the share cannot be reached, or a body finds no place; Error(input) if a wall is
///        touched
Trace make_trace(const Trace_options& options);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H
