// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls of a run as its recording numbers them, while facets and cells change.
#ifndef CELLWALK_CLI_RUN_RECORDED_WALLS_H
#define CELLWALK_CLI_RUN_RECORDED_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/records/recording.h>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace cellwalk::cli {

/// Loops of points, each with a number from its first appearance on.
class Numbered_loops {
 public:
  using Loop = std::vector<std::uint32_t>;

  /// To be called with all loops that are there, between begin() and end().
  void begin() { is_seen_.assign(is_there_.size(), 0); }
  void see(const Loop& loop);
  /// The changes since the last end().
  Loops_change end();

  template <class Archive>
  void archive(Archive& a) {
    a(numbers_, is_there_, is_seen_, added_);
  }

 private:
  std::map<Loop, std::uint32_t> numbers_;
  std::vector<char> is_there_, is_seen_;
  std::vector<Loop> added_;
};

/// Walls seen from free cells; in the plane also free cells and, unless they are too many at the start, the
/// passable edges between them. A loop is known by its points: a wall that comes back gets the number that it
/// had, whatever the names of cells are then.
template <int D>
class Recorded_walls {
 public:
  explicit Recorded_walls(const Snapshot<D>& snapshot) : snapshot_(&snapshot) {}

  /// The changes since the last call; at first all walls.
  /// Cost: linear in the cells, if the environment was edited since.
  Walls_change follow();

  /// The points of the environment that the recording has, in its order.
  std::span<const std::uint32_t> points() const { return points_; }

  template <class Archive>
  void archive(Archive& a) {
    a(epoch_, is_first_, has_lines_, points_, number_, new_points_, walls_, floor_, lines_);
  }

 private:
  void see_cell(Cell cell);
  std::uint32_t number_of(std::uint32_t point);

  const Snapshot<D>* snapshot_;
  std::uint64_t epoch_ = 0;  ///< of the snapshot at the last call
  bool is_first_ = true, has_lines_ = true;
  std::vector<std::uint32_t> points_, number_;  ///< number_: of each point of the environment, or 0
  std::vector<Point<3>> new_points_;
  Numbered_loops walls_, floor_, lines_;
};

extern template class Recorded_walls<2>;
extern template class Recorded_walls<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_RECORDED_WALLS_H
