// SPDX-License-Identifier: LGPL-3.0-or-later
// The recording of a run for `cellwalk view`: everything that moved, step by step, and the walls.
#ifndef CELLWALK_INTERNAL_RECORDS_RECORDING_H
#define CELLWALK_INTERNAL_RECORDS_RECORDING_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// The decision of a body's moves since the previous frame: the most expensive method that any of its
/// vertices and edges needed.
enum class Decision : std::uint8_t {
  none,        ///< it did not move
  region,      ///< in a region free of walls, without a test
  same_cell,   ///< both ends of every edge in one cell; bodies without edges: by walking
  same_chain,  ///< an edge crossed the same facets before and after
  relinked,    ///< the chain of an edge was led round ridges
  events,      ///< by events, or by three segments
  contact      ///< with a contact
};

inline constexpr std::array decision_names{"none",     "region", "same_cell", "same_chain",
                                           "relinked", "events", "contact"};

struct Recording_body {
  bool is_catheter = false;
  std::uint32_t vertices = 0, edges = 0, faces = 0;
  double radius = 0;  ///< the largest of its edges, as which all are shown; 0: they have none
};

/// The data that do not change in a run. 2D points have z = 0.
struct Recording_scene {
  int dimension = 3;
  double time_step = 0;
  std::uint32_t steps = 0;  ///< of the run
  std::uint32_t every = 1;  ///< steps from one frame to the next
  std::uint32_t cells = 0;  ///< of the environment
  std::uint32_t particles = 0;
  std::vector<Recording_body> bodies;
  Point<3> lower{}, upper{};  ///< the bounding box of the environment; wider if walls move
  bool walls_move = false;    ///< then each frame has their points as well
  bool walls_change = false;  ///< then each frame says which walls came and went
  // The walls at the start, with their points.
  std::vector<Point<3>> points;
  /// Walls as loops of points, counterclockwise seen from their solid side; in 2D two points each. A wall
  /// with free space on both sides occurs twice.
  std::vector<std::vector<std::uint32_t>> walls;
  std::vector<std::vector<std::uint32_t>> floor;    ///< 2D only: free cells as loops of points
  std::vector<std::array<std::uint32_t, 2>> lines;  ///< 2D only: passable edges
  /// Of all bodies; vertices are numbered consecutively through all bodies.
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> faces;

  /// The number of frames: at the start, after every `every` steps, and at the end.
  std::uint32_t frame_count() const { return 1 + steps / every + (steps % every != 0); }
  /// The number of moving points: the particles, then the vertices of the bodies.
  std::size_t moving_count() const {
    std::size_t count = particles;
    for (const Recording_body& body : bodies) count += body.vertices;
    return count;
  }
};

/// The changes of loops of points since the previous frame. Loops are numbered in the order in which they
/// first appear, those of the scene before all others; they keep their numbers while they are gone.
struct Loops_change {
  std::vector<std::uint32_t> toggled;  ///< that vanished or came back; ascending
  std::vector<std::vector<std::uint32_t>> added;
};

/// The changes of the walls since the previous frame.
struct Walls_change {
  std::vector<Point<3>> points;  ///< new ones, numbered on; they stay, whether they are used or not
  Loops_change walls, floor, lines;
};

/// One frame: views of the caller's arrays.
struct Recording_frame {
  /// Of all moving points; if walls move, then of all their points so far.
  std::span<const Point<3>> positions;
  /// For each moving point a cell in whose closure it lies, by its number in the input.
  std::span<const std::uint32_t> cells;
  std::span<const Decision> decisions;   ///< of each body
  const Walls_change* change = nullptr;  ///< null: nothing changed
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_RECORDING_H
