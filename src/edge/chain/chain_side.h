// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells with which the chain of a segment is linked at a point. Theory: docs/sweep.md, chains.
#ifndef CELLWALK_EDGE_CHAIN_CHAIN_SIDE_H
#define CELLWALK_EDGE_CHAIN_CHAIN_SIDE_H

#include <cellwalk/edge/chain.h>

#include <optional>
#include <vector>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// An edge of a body by its end points, and as exact numbers.
class Exact_edge {
 public:
  Exact_edge(const Snapshot<3>& snapshot, const Point<3>& from, const Point<3>& to)
      : snapshot_(snapshot), from_(from), to_(to), segment_(from, to) {}

  /// Its part in a closed facet.
  /// Cost: some comparisons and two signs if they prove that there is none.
  std::optional<Span> in_facet(Half_facet f) const;
  std::optional<Span> in_facet(const Cell_view<3>& cell, std::size_t i) const;
  const Snapshot<3>& snapshot() const { return snapshot_; }

 private:
  bool is_apart(const Cell_view<3>& cell, std::size_t i) const;

  const Snapshot<3>& snapshot_;
  Point<3> from_, to_;
  Rational_segment<3> segment_;
};

/// All cells linked, at the point at t, with the cell in which a chain passes it.
/// \pre the edge passes the chain from the cell `start`
std::vector<Cell> linked_cells(const Exact_edge& edge, Cell start, const Chain& chain, const Fraction& t);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CHAIN_SIDE_H
