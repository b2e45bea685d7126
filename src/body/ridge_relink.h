// SPDX-License-Identifier: LGPL-3.0-or-later
// A chain led round the ridges that its edge passes on the way. Theory: docs/sweep.md, relinking at ridges.
#ifndef CELLWALK_BODY_RIDGE_RELINK_H
#define CELLWALK_BODY_RIDGE_RELINK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/certain_line.h>

#include <array>

namespace cellwalk::detail {

/// Leads a word round ridges until a line certainly passes it: runs of facets that have but one ridge beyond
/// the line, the same in all, are exchanged for those on the other side of the ridge. Then the edge is free
/// on its way, and the new word is its chain.
/// \param word the facets seen from the cells on the side of the first end of the edge
/// \param line leads from the moved end to the other one, or backwards, so that it should pass the facets
///        outwards
/// \param ends the first end of the edge and the second, in the frame
/// False is inconclusive; then the word is of no use.
/// Cost: reading the corners of each facet.
template <int D>
bool relink_at_ridges(const Snapshot<D>& snapshot, const Certain_line<D>& line,
                      const std::array<Spread_point<D>, 2>& ends, Chain& word);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_RIDGE_RELINK_H
