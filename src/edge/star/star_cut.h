// SPDX-License-Identifier: LGPL-3.0-or-later
// An edge cut where it enters and leaves cells around a moving vertex, at an exact time, and which of them
// are linked along it. Theory: docs/moving.md, touches.
#ifndef CELLWALK_EDGE_STAR_STAR_CUT_H
#define CELLWALK_EDGE_STAR_STAR_CUT_H

#include <cellwalk/edge/chain.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "star_segment.h"

namespace cellwalk::detail {

/// Cells by number, in the order in which they are found.
template <int D>
class Star_cut {
 public:
  /// Finds the cells reached through passable facets that meet the edge.
  /// \param start a free cell that holds the first end
  /// \pre the segment outlives the cut
  Star_cut(const Star_segment<D>& segment, Cell start);

  std::size_t pieces() const { return points_.size() - 1; }
  const Fraction& point(std::size_t k) const { return points_[k].at; }
  /// Where a point goes at the end of an interval in which nothing changes.
  Fraction limit(std::size_t k, const Star_segment<D>& then) const;

  /// The number of a cell; the count of cells if it is none of them.
  std::size_t number_of(Cell c) const;
  Cell cell(std::size_t number) const { return cells_[number].cell; }
  std::size_t cell_count() const { return cells_.size(); }

  /// For each cell that holds all of the edge between two points, the least cell linked with it all along;
  /// -1 for others.
  const std::vector<int>& at(std::size_t point) const { return at_[point]; }
  const std::vector<int>& along(std::size_t piece) const { return along_[piece]; }

  /// The first point of a facet that the edge meets, and the last one; none if it does not.
  std::optional<std::pair<std::size_t, std::size_t>> met(Half_facet f) const;
  /// Appends the facets of a way between cells that are linked at a point.
  void append_way(std::size_t from, std::size_t to, std::size_t point, Chain& chain) const;
  /// Walls that the edge meets, and where.
  const std::vector<std::pair<Half_facet, Span>>& walls() const { return walls_; }

 private:
  struct Point_of_cut {
    Fraction at;
    Half_facet facet = Half_facet::none;  ///< with the vertex, whose border passes there; else it stays
    int border = -1;
  };
  struct Cell_met {
    Cell cell;
    std::size_t first, last;
  };
  struct Link {
    std::size_t from, to;
    Half_facet facet;
    std::size_t first, last;
  };
  std::vector<int> classes(std::size_t first, std::size_t last) const;

  std::vector<Point_of_cut> points_;
  std::vector<Cell_met> cells_;
  std::vector<Link> links_;  ///< each passable facet from both sides
  std::vector<std::pair<Half_facet, Span>> walls_;
  std::vector<std::vector<int>> at_, along_;
};

extern template class Star_cut<2>;
extern template class Star_cut<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_STAR_STAR_CUT_H
