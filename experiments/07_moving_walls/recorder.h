// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves the walls by Cellwalk, and records what all peers are asked then.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_RECORDER_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_RECORDER_H

#include <cstdint>
#include <vector>

#include "scene.h"
#include "walls.h"

namespace cellwalk::moving_walls {

struct Recorded_step {
  std::vector<Wall_move> moves;
  std::vector<std::uint8_t> blocked;  ///< Cellwalk's answers
  std::uint64_t point_moves = 0, dropped = 0;
  double move_us = 0, close_us = 0;
  Reshape_counts counts;
};

/// Moves the points of a scene one after the other, each once, by At_contact::stop.
Recorded_step record_step(Scene& scene, const Walls& walls, double time);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_RECORDER_H
