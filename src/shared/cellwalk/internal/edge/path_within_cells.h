// SPDX-License-Identifier: LGPL-3.0-or-later
// Ways of an edge through given cells between which there is no wall. Theory: docs/moving.md.
#ifndef CELLWALK_INTERNAL_EDGE_PATH_WITHIN_CELLS_H
#define CELLWALK_INTERNAL_EDGE_PATH_WITHIN_CELLS_H

#include <cellwalk/edge/chain.h>

#include <span>

namespace cellwalk::detail {

/// Appends a facet to a word, or deletes the last one if it is the same in the other direction: words are
/// reduced freely. Theory: docs/sweep.md.
template <int D>
void append_reduced(const Snapshot<D>& snapshot, Chain& chain, Half_facet f) {
  if (!chain.empty() && snapshot.neighbour(f) == snapshot.cell_of(chain.back()) &&
      snapshot.opposite(f) == chain.back())
    chain.pop_back();
  else
    chain.push_back(f);
}

/// A particle in a cell that holds it.
template <int D>
Particle<D> particle_in(const Snapshot<D>& snapshot, Cell cell, const Particle<D>& p, Walk_counts& counts);

/// Finds ways that do not leave some cells. All ways between two cells along an edge are equal in them, so
/// any will do.
template <int D>
class Path_within_cells {
 public:
  /// \param cells ascending; they outlive this
  Path_within_cells(const Snapshot<D>& snapshot, std::span<const Cell> cells, Walk_counts& counts)
      : snapshot_(snapshot), cells_(cells), counts_(counts) {}

  /// Appends the facets through which the edge pq passes from one of the cells to another to the chain before
  /// them.
  /// \throw Error(other) if there is no such way
  /// Cost: some signs a cell; exact numbers where it passes ridges and vertices.
  void append(Chain& chain, Cell from, Cell to, const Point<D>& p, const Point<D>& q) const;

 private:
  bool has(Cell cell) const;
  bool may_pass(Half_facet f) const;
  bool append_by_signs(Chain& chain, Cell from, Cell to, const Point<D>& p, const Point<D>& q) const;
  Half_facet exit_by_signs(Cell from, const Point<D>& p, const Point<D>& q) const;
  bool append_exactly(Chain& chain, Cell from, Cell to, const Point<D>& p, const Point<D>& q) const;

  const Snapshot<D>& snapshot_;
  std::span<const Cell> cells_;
  Walk_counts& counts_;
};

extern template class Path_within_cells<2>;
extern template class Path_within_cells<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_PATH_WITHIN_CELLS_H
