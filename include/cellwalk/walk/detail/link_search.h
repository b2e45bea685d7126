// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells linked at a point, round a ridge or along a segment: passable facets that hold it join them. Theory: docs/sweep.md, chains.
#ifndef CELLWALK_WALK_DETAIL_LINK_SEARCH_H
#define CELLWALK_WALK_DETAIL_LINK_SEARCH_H

#include <cellwalk/environment/snapshot.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cellwalk::detail {

/// Finds the cells linked with one, breadth first. The rule holds(cell, i), given with each step, tells of which facets they are to be
/// linked through:
///
///   Link_search<D> links(snapshot, start);
///   while (links.next()) links.expand(holds);
///
/// Cells are numbered by their places in the order in which they are found. That order is part of what walks and chains are: where
/// several ways lead to a cell, the first one found is taken.
template <int D>
class Link_search {
 public:
  Link_search(const Snapshot<D>& snapshot, Cell start)
      : snapshot_(snapshot), found_{{start, 0, Half_facet::none}} {}

  /// Visits the next cell, first the start. False if all cells found were visited.
  bool next() {
    if (visited_ == found_.size()) return false;
    ++visited_;
    return true;
  }
  /// The place of the cell visited.
  std::size_t place() const { return visited_ - 1; }
  /// The cell visited.
  Cell cell() const { return cell(place()); }
  Cell cell(std::size_t place) const { return found_[place].cell; }
  bool contains(Cell c) const {
    return std::any_of(found_.begin(), found_.end(), [c](const Found& known) { return known.cell == c; });
  }

  /// Finds the cells behind those passable facets of the cell visited that hold. The rule is asked only of passable facets of
  /// which the cell behind is not found yet.
  template <class Holds>
  void expand(const Holds& holds) {
    const Cell c = cell();
    const Cell_view<D> view = snapshot_.view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot_.is_impassable(f)) continue;
      const Cell behind = snapshot_.neighbor(f);
      if (!contains(behind) && holds(view, i)) found_.push_back({behind, place(), f});
    }
  }

  /// The same, but the rule is asked of all facets of the cell visited, and walls that hold are passed to on_wall(cell, i, wall).
  template <class Holds, class On_wall>
  void expand_all(const Holds& holds, const On_wall& on_wall) {
    const Cell c = cell();
    const Cell_view<D> view = snapshot_.view(c);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      if (!holds(view, i)) continue;
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot_.is_impassable(f))
        on_wall(view, i, f);
      else if (const Cell behind = snapshot_.neighbor(f); !contains(behind))
        found_.push_back({behind, place(), f});
    }
  }

  /// Appends the facets on the way from the start to the cell at a place, each seen from the cell on the side of the start.
  template <class Facets>
  void append_way(std::size_t place, Facets& facets) const {
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

#endif  // CELLWALK_WALK_DETAIL_LINK_SEARCH_H
