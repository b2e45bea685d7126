// SPDX-License-Identifier: LGPL-3.0-or-later
// What moved in a run, step by step, and the walls it moved among: what a page needs to replay it.
#ifndef CELLWALK_RECORDS_MOTION_H
#define CELLWALK_RECORDS_MOTION_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// How the moves of a body were decided since the record before: the costliest way that any of its vertices and edges needed.
enum class Decision : std::uint8_t {
  none,         ///< it was not asked to move
  region,       ///< in a region free of walls, without a test
  same_cell,    ///< both ends of every edge in one cell; bodies without edges: by walking
  convex_pair,  ///< the ends of an edge in two cells that make a convex one
  same_chain,   ///< an edge passed the same facets before and after
  clear,        ///< no wall meets the triangle that an edge swept
  events,       ///< event by event, or by three segments
  contact       ///< something met a wall
};

inline constexpr std::array decision_names{"none",       "region", "same_cell", "convex_pair",
                                           "same_chain", "clear",  "events",    "contact"};

struct Motion_body {
  bool is_catheter = false;
  std::uint32_t vertices = 0, edges = 0, faces = 0;
};

/// What does not change in a run. Points of the plane have z = 0.
struct Motion_scene {
  int dimension = 3;
  double time_step = 0;
  std::uint32_t steps = 0;  ///< of the run
  std::uint32_t every = 1;  ///< steps from one record to the next
  std::uint32_t cells = 0;  ///< of the environment
  std::uint32_t particles = 0;
  std::vector<Motion_body> bodies;
  Point<3> lower{}, upper{};  ///< the box of the environment
  std::vector<Point<3>> points;
  /// Walls as loops of points, counterclockwise seen from their solid side; in the plane two points each. A wall with free space
  /// on both sides occurs twice.
  std::vector<std::vector<std::uint32_t>> walls;
  std::vector<std::vector<std::uint32_t>> floor;    ///< in the plane only: free cells as loops of points
  std::vector<std::array<std::uint32_t, 2>> lines;  ///< in the plane only: passable edges
  std::vector<std::array<std::uint32_t, 2>>
      edges;  ///< of all bodies; vertices are counted through all bodies
  std::vector<std::array<std::uint32_t, 3>> faces;

  /// Records of a run: at the start, after every `every` steps, and at the end.
  std::uint32_t record_count() const { return 1 + steps / every + (steps % every != 0); }
  /// Points that move: the particles, then the vertices of the bodies.
  std::size_t moving_count() const {
    std::size_t count = particles;
    for (const Motion_body& body : bodies) count += body.vertices;
    return count;
  }
};

/// One record: views of the caller's arrays.
struct Motion_frame {
  std::span<const Point<3>> positions;  ///< of all that moves
  std::span<const std::uint32_t>
      cells;  ///< for each a cell in whose closure it lies, by its number in the input
  std::span<const Decision> decisions;  ///< of each body
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_MOTION_H
