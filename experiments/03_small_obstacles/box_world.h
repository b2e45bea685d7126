// SPDX-License-Identifier: LGPL-3.0-or-later
// A grid of unit cubes (2D: squares), in each of which a small box floats: obstacles of a known size, spread
// evenly.
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_BOX_WORLD_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_BOX_WORLD_H

#include <cellwalk/environment/environment.h>

#include <cstdint>

namespace cellwalk::small_obstacles {

/// Room between a box and the sides of its cube, in cubes.
inline constexpr double box_margin = 0.03125;

template <int D>
struct Box_world_options {
  std::uint32_t cubes = 10;  ///< along each axis
  double side = 0.25;        ///< of the boxes, in (0, 1 - 2 box_margin)
  std::uint64_t seed = 1;    ///< where in their cubes they are
};

/// The certified grid. Each cube is cut into its box, which is solid, and a frustum between each side of the
/// box and the side of the cube. The boxes have sides along the axes and lie at random places; the grid
/// starts at the origin.
/// Cost: some 5 us a cube.
template <int D>
Environment<D> box_world(const Box_world_options<D>& options);

extern template Environment<2> box_world<2>(const Box_world_options<2>&);
extern template Environment<3> box_world<3>(const Box_world_options<3>&);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_BOX_WORLD_H
