// SPDX-License-Identifier: LGPL-3.0-or-later
// What all methods know: the triangles of the walls, the moves of their vertices, and the edges of the
// bodies.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_WALLS_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_WALLS_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/snapshot.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/peers/box.h"

namespace cellwalk::moving_walls {

using experiments::Box;

inline constexpr std::uint32_t nothing = 0xffffffffu;

/// The walls of an environment of simplices without membranes. Their vertices have numbers of their own.
struct Walls {
  explicit Walls(const Snapshot<3>& snapshot);

  std::vector<std::uint32_t> points;     ///< the point of the environment of each vertex, ascending
  std::vector<std::uint32_t> vertex_of;  ///< the vertex of each point of the environment, or `nothing`
  /// Free space is on the positive side: orientation(a, b, c, x) > 0.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> first_at, at;  ///< triangles of vertex v: at[first_at[v]] to at[first_at[v + 1]]

  std::span<const std::uint32_t> triangles_at(std::uint32_t vertex) const {
    return {at.data() + first_at[vertex], at.data() + first_at[vertex + 1]};
  }
};

/// A move of a vertex of the walls, as it was recorded. In a step these follow one another.
struct Wall_move {
  std::uint32_t vertex;
  Point<3> from, to;
  Point<3> after;  ///< where it was then: `to`, or where it stopped
};

/// The edges of all bodies, which stand still, in groups that are near each other: 8 edges of the catheter,
/// or a soft body.
struct Body_edges {
  explicit Body_edges(std::span<const std::unique_ptr<Body<3>>> bodies);

  std::vector<std::array<Point<3>, 2>> ends;
  /// Enlarged by 2^11 units in the last place of the largest coordinate, since a wall that stops may be that
  /// far off its straight way.
  std::vector<Box> boxes;
  struct Group {
    std::uint32_t begin, end;
    Box box;
  };
  std::vector<Group> groups;
};

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_WALLS_H
