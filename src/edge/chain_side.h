// SPDX-License-Identifier: LGPL-3.0-or-later
// On which side of a wall does the chain of a segment pass? Theory: docs/sweep.md, chains.
#ifndef CELLWALK_EDGE_CHAIN_SIDE_H
#define CELLWALK_EDGE_CHAIN_SIDE_H

#include <cellwalk/edge/chain.h>

#include <optional>
#include <vector>

#include "rational_segment.h"

namespace cellwalk::detail {

/// All cells linked, at the point of the segment with this parameter, with the one in which a chain passes it.
/// \pre the segment passes the chain, from the cell `start`
std::vector<Cell> linked_cells(const Snapshot<3>& snapshot, const Rational_segment<3>& segment, Cell start,
                               const Chain& chain, const Rational& t);

/// The side of a wall on which a chain passes that meets it: the half-facet whose cell is linked there with that of the chain. No value if
/// both are (round the rim of the wall), or the segment misses the wall.
/// \pre the segment passes the chain, from the cell `start`
std::optional<Half_facet> passed_side(const Snapshot<3>& snapshot, const Rational_segment<3>& segment,
                                      Cell start, const Chain& chain, Half_facet wall);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_SIDE_H
