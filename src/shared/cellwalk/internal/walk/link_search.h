// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for cells that are linked at a point, around a ridge or along a segment, by passable facets that
// contain it. Theory: docs/sweep.md, chains.
#ifndef CELLWALK_INTERNAL_WALK_LINK_SEARCH_H
#define CELLWALK_INTERNAL_WALK_LINK_SEARCH_H

#include <cellwalk/environment/snapshot.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cellwalk::detail {

/// Finds the cells linked with a start cell, breadth first. The rule holds(cell, i), given with each step,
/// selects the facets through which cells are linked:
///
///   Link_search<D> links(snapshot, start);
///   while (links.next()) links.expand(holds);
///
/// Cells are numbered in the order in which they are found. Walks and chains depend on this order: if several
/// paths lead to a cell, the first one found is used.
template <int D>
class Link_search {
 public:
  Link_search(const Snapshot<D>& snapshot, Cell start)
      : snapshot_(snapshot), found_{{start, 0, Half_facet::none}} {}

  /// Visits the next cell, first the start. Returns false if all cells found were visited.
  bool next() {
    if (visited_ == found_.size()) return false;
    ++visited_;
    return true;
  }
  /// The number of the visited cell.
  std::size_t place() const { return visited_ - 1; }
  /// The visited cell.
  Cell cell() const { return cell(place()); }
  Cell cell(std::size_t place) const { return found_[place].cell; }
  bool contains(Cell c) const {
    return std::any_of(found_.begin(), found_.end(), [c](const Found& known) { return known.cell == c; });
  }

  /// Finds the cells behind those passable facets of the visited cell for which the rule holds. The rule is
  /// evaluated only for passable facets whose neighbour is not found yet.
  template <class Holds>
  void expand(const Holds& holds) {
    const Cell c = cell();
    const Cell_view<D> view = snapshot_.view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot_.is_impassable(f)) continue;
      const Cell behind = snapshot_.neighbour(f);
      if (!contains(behind) && holds(view, i)) found_.push_back({behind, place(), f});
    }
  }

  /// The same, but the rule is evaluated for all facets of the visited cell, and on_wall(cell, i, wall) is
  /// called for walls for which it holds.
  template <class Holds, class On_wall>
  void expand_all(const Holds& holds, const On_wall& on_wall) {
    const Cell c = cell();
    const Cell_view<D> view = snapshot_.view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      if (!holds(view, i)) continue;
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot_.is_impassable(f))
        on_wall(view, i, f);
      else if (const Cell behind = snapshot_.neighbour(f); !contains(behind))
        found_.push_back({behind, place(), f});
    }
  }

  /// Appends the facets on the path from the start to the cell of the given number, each seen from the cell
  /// on the side of the start.
  template <class Facets>
  void append_path(std::size_t place, Facets& facets) const {
    const auto end = static_cast<std::ptrdiff_t>(facets.size());
    for (std::size_t i = place; i != 0; i = found_[i].parent) facets.push_back(found_[i].facet);
    std::reverse(facets.begin() + end, facets.end());
  }

 private:
  struct Found {
    Cell cell;
    std::size_t parent;
    Half_facet facet;  ///< of the parent
  };

  const Snapshot<D>& snapshot_;
  boost::container::small_vector<Found, 32> found_;
  std::size_t visited_ = 0;  ///< cells
};

/// All cells linked with one, in the order of the search.
template <int D, class Holds>
std::vector<Cell> linked_cells(const Snapshot<D>& snapshot, Cell start, const Holds& holds) {
  std::vector<Cell> cells;
  Link_search<D> links(snapshot, start);
  while (links.next()) {
    cells.push_back(links.cell());
    links.expand(holds);
  }
  return cells;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_LINK_SEARCH_H
