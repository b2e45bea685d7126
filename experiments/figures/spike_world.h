// SPDX-License-Identifier: LGPL-3.0-or-later
// Unit cubes with thin pyramids on the floor.
#ifndef CELLWALK_EXPERIMENTS_FIGURES_SPIKE_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURES_SPIKE_WORLD_H

#include <cellwalk/environment/environment.h>

#include <array>
#include <vector>

namespace cellwalk::figures {

/// A pyramid whose base is a square in the middle of the floor of a cube, and whose tip is over that.
struct Spike {
  std::uint32_t x, y;  ///< the cube
  double height;       ///< in (0,1)
  double half_width;   ///< of the base, in (0,1/2)
};

/// A certified grid of unit cubes. A cube with a spike is cut into pyramids that meet in its tip: the spike,
/// which is a solid cell, four round it, four to the sides and one to the top.
Environment<3> spike_world(const std::array<std::uint32_t, 3>& cubes, const std::vector<Spike>& spikes);

}  // namespace cellwalk::figures

#endif  // CELLWALK_EXPERIMENTS_FIGURES_SPIKE_WORLD_H
