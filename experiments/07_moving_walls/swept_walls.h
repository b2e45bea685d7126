// SPDX-License-Identifier: LGPL-3.0-or-later
// The boxes of what walls sweep in a step, which peers keep in their hierarchies: computed once a step for
// all of them, and counted for each.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_SWEPT_WALLS_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_SWEPT_WALLS_H

#include <cstdint>
#include <span>
#include <vector>

#include "narrow.h"
#include "walls.h"

namespace cellwalk::moving_walls {

class Swept_walls {
 public:
  /// \param positions of the vertices of the walls
  Swept_walls(const Walls& walls, std::vector<Point<3>> positions);

  /// Goes on to the next step: vertices that moved in the last one are where they were after it. A box holds
  /// its triangle wherever its vertices are between `from` and `to`.
  /// Cost: that of the triangles at vertices that move.
  void begin(std::span<const Wall_move> moves);

  const Walls& walls() const { return walls_; }
  const std::vector<Box>& boxes() const { return boxes_; }  ///< of all triangles
  /// The triangles at vertices that move; the boxes of others are as before.
  const std::vector<std::uint32_t>& touched() const { return touched_; }
  bool is_touched(std::uint32_t triangle) const { return stamp_[triangle] == step_; }
  const Box& touched_box() const { return touched_box_; }  ///< of all touched triangles
  std::span<const Wall_move> moves() const { return moves_; }
  std::span<const Wall_move> last_moves() const { return last_moves_; }
  const std::vector<Point<3>>& positions() const { return before_; }  ///< before the step
  const std::vector<Point<3>>& targets() const { return target_; }    ///< positions of those that do not move
  /// The number of the move of a vertex, or `nothing`.
  std::uint32_t rank(std::uint32_t vertex) const { return rank_[vertex]; }
  /// Where a vertex is just before a move.
  const Point<3>& position(std::uint32_t vertex, std::uint32_t move) const {
    return rank_[vertex] < move ? moves_[rank_[vertex]].after : before_[vertex];
  }

 private:
  Box box_of(std::uint32_t triangle) const;

  const Walls& walls_;
  std::vector<Point<3>> before_, target_;
  std::vector<std::uint32_t> rank_;
  std::vector<Wall_move> moves_, last_moves_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> touched_, stamp_;  ///< stamp: the last step in which a triangle was touched
  std::uint32_t step_ = 0;
  Box touched_box_ = Box::nowhere();
};

/// A triangle while the vertex of a move goes; it must have that vertex.
Moving_wall moving_wall(const Swept_walls& walls, std::uint32_t triangle, std::uint32_t move);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_SWEPT_WALLS_H
