// SPDX-License-Identifier: LGPL-3.0-or-later
// Equality of two chains of one segment: they are linked at each of its points. Theory: docs/sweep.md.
#ifndef CELLWALK_EDGE_CHAIN_EQUAL_CHAINS_H
#define CELLWALK_EDGE_CHAIN_EQUAL_CHAINS_H

#include <cellwalk/edge/chain.h>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// A part of a segment, and the cell through which a chain passes there.
struct Piece {
  Cell cell;
  Fraction low, high;
};

/// The pieces of a chain that starts in a cell at parameter 0 and ends at `end`; one more than the chain has
/// facets.
/// \pre the segment passes the chain there
template <int D>
std::vector<Piece> pieces_of(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
                             std::span<const Half_facet> chain, const Fraction& end);

/// The parting of two chains of a segment: they are linked up to a parameter, but not after it, because of a
/// wall.
struct Parting {
  Fraction at;
  Half_facet wall;
};

/// The first parting of two chains that start together, up to the end of the shorter one.
template <int D>
std::optional<Parting> parting_of(const Snapshot<D>& snapshot, const Rational_segment<D>& segment,
                                  const std::vector<Piece>& chain, const std::vector<Piece>& other);

/// The passable facets on the path from one cell to another, all of which contain the point at t.
/// \pre the cells are linked there
template <int D>
std::vector<Half_facet> link_at(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell from,
                                Cell to, const Fraction& t);

/// Compares two chains that start in the cell `start`, both passed by the segment. If they are not equal,
/// `wall` is set to a wall that parts them.
template <int D>
bool are_equal(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
               const Chain& chain, const Chain& other, Half_facet& wall);

#define CELLWALK_DECLARE(D)                                                                                  \
  extern template std::vector<Piece> pieces_of<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell,      \
                                                  std::span<const Half_facet>, const Fraction&);             \
  extern template std::optional<Parting> parting_of<D>(                                                      \
      const Snapshot<D>&, const Rational_segment<D>&, const std::vector<Piece>&, const std::vector<Piece>&); \
  extern template std::vector<Half_facet> link_at<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell,   \
                                                     Cell, const Fraction&);                                 \
  extern template bool are_equal<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell, const Chain&,      \
                                    const Chain&, Half_facet&);

CELLWALK_DECLARE(2)
CELLWALK_DECLARE(3)

#undef CELLWALK_DECLARE

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_EQUAL_CHAINS_H
