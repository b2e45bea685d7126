// SPDX-License-Identifier: LGPL-3.0-or-later
// Vertices and edges at facets that are to become walls: the sides on which they may be then. Theory:
// docs/cutting.md.
#ifndef CELLWALK_INTERNAL_EDGE_CLOSING_H
#define CELLWALK_INTERNAL_EDGE_CLOSING_H

#include <cellwalk/edge/chain.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// Passable facets that are to become walls, and a cell that is to become solid; all is still as it was.
struct Closing {
  std::span<const Half_facet> facets;  ///< both sides of each, ascending
  Cell filled = Cell::none;            ///< or none: all its passable facets are among them

  bool has(Half_facet f) const { return std::binary_search(facets.begin(), facets.end(), f); }
};

/// True if a segment passes a facet from one side to the other, in its relative interior.
template <int D>
bool crosses_inside(const Snapshot<D>& snapshot, Half_facet facet, const Point<D>& p, const Point<D>& q,
                    Walk_counts& counts);

/// True if a part of positive length of a segment lies in a closed facet.
template <int D>
bool lies_along(const Snapshot<D>& snapshot, Half_facet facet, const Point<D>& p, const Point<D>& q,
                Walk_counts& counts);

/// The sides on which a vertex may be once all is closed: a particle for each class of cells that are linked
/// with its own now, and with each other then. First its own, if that stays free; none if none does.
/// Cost: nothing inside of a cell that stays free; else the facets of the cells linked with it.
template <int D>
std::vector<Particle<D>> sides_after(const Snapshot<D>& snapshot, const Particle<D>& particle,
                                     const Closing& closing, Walk_counts& counts);

/// An edge whose chain may have to change.
template <int D>
struct Closing_edge {
  const Particle<D>&p, &q;            ///< as they are registered now
  const Chain& chain;                 ///< now
  const Particle<D>&p_then, &q_then;  ///< as they will be: each a result of sides_after()
  /// Towards these points faces extend from the edge. Its chain must pass cells in which they begin.
  std::span<const Point<D>> tips;
  /// Where the edge lies in one of these closed facets, its chain must be linked with the cell of that.
  std::span<const Half_facet> at;
};

/// A chain of an edge once all is closed, equal to the one it has now; none if there is none.
/// Cost: nothing if the chain can stay; else exact numbers for all facets of the cells along the edge.
template <int D>
std::optional<Chain> chain_after(const Snapshot<D>& snapshot, const Closing_edge<D>& edge,
                                 const Closing& closing, Walk_counts& counts);

#define CELLWALK_DECLARE(D)                                                                                \
  extern template bool crosses_inside<D>(const Snapshot<D>&, Half_facet, const Point<D>&, const Point<D>&, \
                                         Walk_counts&);                                                    \
  extern template bool lies_along<D>(const Snapshot<D>&, Half_facet, const Point<D>&, const Point<D>&,     \
                                     Walk_counts&);                                                        \
  extern template std::vector<Particle<D>> sides_after<D>(const Snapshot<D>&, const Particle<D>&,          \
                                                          const Closing&, Walk_counts&);                   \
  extern template std::optional<Chain> chain_after<D>(const Snapshot<D>&, const Closing_edge<D>&,          \
                                                      const Closing&, Walk_counts&);

CELLWALK_DECLARE(2)
CELLWALK_DECLARE(3)

#undef CELLWALK_DECLARE

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_CLOSING_H
