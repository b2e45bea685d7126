// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells that a tetrahedron may meet, found from one of them through passable facets, and the walls near
// it.
#ifndef CELLWALK_EDGE_FACE_BROAD_PHASE_H
#define CELLWALK_EDGE_FACE_BROAD_PHASE_H

#include <cellwalk/internal/edge/face.h>

#include <array>
#include <cstddef>
#include <unordered_set>

namespace cellwalk::detail {

/// Cells in the order in which they were found.
class Cell_set {
 public:
  explicit Cell_set(Cell first) : cells_{first} {}

  bool contains(Cell c) const;
  void add(Cell c);
  std::size_t size() const { return cells_.size(); }
  Cell operator[](std::size_t i) const { return cells_[i]; }

 private:
  static constexpr std::size_t most_searched = 32;  ///< cells compared one by one; about as fast as hashing
  boost::container::small_vector<Cell, most_searched> cells_;
  std::unordered_set<Cell> index_;  ///< of all cells, once they are more
};

/// The result of a flood from a cell.
struct Candidate_walls {
  explicit Candidate_walls(Cell start) : cells(start) {}

  Cell_set cells;
  /// Each wall once, seen from the first of its cells that was found.
  boost::container::small_vector<Half_facet, 8> walls;
};

using Corners = std::array<Point<3>, 4>;

/// Finds the cells reached from the first one through passable facets that may meet the closed tetrahedron,
/// and all walls of these cells that may meet it. Planes and boxes that are inconclusive count as met.
/// Cost: a few ns a cell if no facet is near, otherwise up to some hundred.
void find_candidate_walls(const Snapshot<3>& snapshot, const Corners& corners, Candidate_walls& candidates,
                          Face_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_BROAD_PHASE_H
