// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to simulation: where a centre line may begin or end.
#ifndef CELLWALK_SIMULATION_BODIES_LINE_END_H
#define CELLWALK_SIMULATION_BODIES_LINE_END_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/records/scene.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace cellwalk::detail {

/// A point, or the middle of a group and the cells at it.
template <int D>
struct Line_end {
  /// \param key "from" or "to"
  /// \throw Error as find_centre_line()
  Line_end(const Snapshot<D>& snapshot, const Groups<D>& groups, const Catheter_end<D>& end, const char* key);

  /// Places for the end of the line, the best first: the point itself, or before the middle of the group.
  std::vector<Point<D>> places() const;

  std::string name;         ///< in messages
  std::vector<Cell> cells;  ///< free ones, at least one, ascending
  Point<D> middle{};
  Vector<D> inwards{};        ///< of the length of the radius of a disc of the group's area; 0 if it has none
  std::set<Half_facet> open;  ///< its facets, which are no walls for the line

 private:
  void find_point(const Snapshot<D>& snapshot, const Point<D>& point);
  void find_group(const Snapshot<D>& snapshot, const Selection<D>& group);
};

/// The number of cells that passable facets join to a cell, itself included.
template <int D>
std::size_t cells_joined_to(const Snapshot<D>& snapshot, Cell cell);

extern template struct Line_end<2>;
extern template struct Line_end<3>;
extern template std::size_t cells_joined_to(const Snapshot<2>&, Cell);
extern template std::size_t cells_joined_to(const Snapshot<3>&, Cell);

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_LINE_END_H
