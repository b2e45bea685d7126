// SPDX-License-Identifier: LGPL-3.0-or-later
// 2D rooms: adjacent rectangles, joined by doorways in thin walls, with polygonal obstacles.
#ifndef CELLWALK_GENERATORS_ROOM_H
#define CELLWALK_GENERATORS_ROOM_H

#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>

namespace cellwalk {

/// Rooms of squares. Lengths are in squares.
struct Room_options {
  std::array<std::uint32_t, 2> rooms{3, 2};        ///< along each axis
  std::array<std::uint32_t, 2> room_size{12, 10};  ///< at least 3
  std::uint32_t door = 2;                          ///< width of the doorway in each wall between two rooms
  std::uint32_t obstacles = 3;  ///< in each room: star-shaped polygons with 3 to 9 corners, not all convex
  bool keep_obstacles = false;  ///< true: they are kept as solid cells; false: they are omitted
  double square = 1;            ///< edge of a square
  std::uint64_t seed = 1;       ///< positions of doors and obstacles, and shapes of obstacles
};

/// Squares, and triangles around the obstacles. Walls between rooms are membranes. All rooms are connected:
/// each obstacle lies inside its own three by three squares, with space to pass.
/// \throw Error(usage) for options out of range, or if the obstacles do not fit into a room
/// Cost: about 1 us a cell.
Cell_soup<2> room_2d(const Room_options& options);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_ROOM_H
