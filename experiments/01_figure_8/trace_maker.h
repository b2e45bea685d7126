// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene of the paper's figure 8, recorded: hexahedra fly through a grid with solid cells.
// Paper: section IV.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H

#include <cellwalk/internal/records/body_trace.h>

#include <array>
#include <cstdint>
#include <optional>

namespace cellwalk::figure_8 {

enum class Motion {
  deforming,  ///< that of the paper: bodies deform where they meet walls, recover their shape, and bounce
  rigid       ///< vertices aim at a rigid body, which takes another course where a wall holds one back
};

struct Trace_options {
  Motion motion = Motion::deforming;
  std::array<std::uint32_t, 3> cells{10, 10, 10};
  /// Up to an eighth: solid cells touch each other nowhere; above: drawn one by one, they may.
  double solid_share = 0.1;
  double body_side = 0.3;       ///< in cells
  std::optional<double> speed;  ///< cells a step; none: that of the scene (0.06), of rigid bodies 0.02
  std::uint32_t bodies = 225, steps = 100;
  std::uint64_t seed = 1;  ///< of the solid cells; of the places and courses of rigid bodies as well
};

struct Made_trace {
  Body_trace trace;  ///< of hexahedra in a grid, where touches block
  double speed = 0;  ///< cells a step
};

/// Makes a trace. The answers are those of Target_recorder. Same options, same bytes, on every machine.
///
/// Deforming bodies are those of `cellwalk run` without a scene (data/hexahedra.json): the same material, at
/// the same places with the same velocities where the grid is the same. World moves them, but by the rule of
/// traces: a vertex that meets a wall, or has an edge that would, stays where it is; its contact reflects the
/// velocities, and shape matching draws it back to its place in the body.
///
/// Rigid bodies start turned at random. In each step the vertices aim at the rigid body nearest to them,
/// moved on and turned a little; a body of which a vertex was held back flies another way.
/// \throw Error(usage) if the share cannot be reached, or a rigid body finds no place; Error(outside) if a
///        deforming one does not; Error(input) if a wall is touched
Made_trace make_trace(const Trace_options& options);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_MAKER_H
