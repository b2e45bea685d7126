// SPDX-License-Identifier: LGPL-3.0-or-later
// A room with one obstacle: a spike on its floor, or a box that floats.
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SPIKE_ROOM_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SPIKE_ROOM_H

#include <cellwalk/environment/environment.h>

namespace cellwalk::small_obstacles {

/// The room is a box about the z axis, from z = 0 up.
struct Room {
  double half_width = 8, height = 8;
};

/// Sides of the base of a spike: a regular polygon.
inline constexpr int spike_sides = 16;

/// A pyramid on the floor: base about the origin, tip above it.
struct Spike {
  double height = 1;  ///< less than that of the room
  double radius = 1;  ///< of the circle through the corners of the base, less than the half width of the room
};

/// The radius of the greatest circle in the base: the spike contains the cone over it.
double inner_radius(const Spike& spike);

/// The certified room; all its cells meet in the tip.
Environment<3> spike_room(const Room& room, const Spike& spike);

/// The certified room with a cube that floats about (0, 0, height / 2), cut into frusta.
Environment<3> floating_room(const Room& room, double side);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_SPIKE_ROOM_H
