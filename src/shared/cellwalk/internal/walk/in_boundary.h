// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions in the boundary of a cell, and the ridges and vertices on their path at which walls may begin.
// Rule: docs/walk.md, choices.
#ifndef CELLWALK_INTERNAL_WALK_IN_BOUNDARY_H
#define CELLWALK_INTERNAL_WALK_IN_BOUNDARY_H

#include <cellwalk/internal/walk/signs.h>

namespace cellwalk::detail {

/// The next ridge or vertex of a cell, after the one passed last, that the segment ab passes while it runs in
/// the plane of a facet of the cell, and before it leaves the cell or ends in it; the start itself where
/// nothing was passed yet. Exit::none if there is none, or the segment runs through the inside.
/// \pre a piece of the segment after the place passed last lies in the closed cell; `ends` if it ends there
/// Cost: some signs; exact numbers where the segment lies in the planes of several facets.
template <int D>
Exit next_in_boundary(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, const Exit& passed,
                      bool ends, Walk_counts& counts);

extern template Exit next_in_boundary<2>(const Cell_view<2>&, const Point<2>&, const Point<2>&, const Exit&,
                                         bool, Walk_counts&);
extern template Exit next_in_boundary<3>(const Cell_view<3>&, const Point<3>&, const Point<3>&, const Exit&,
                                         bool, Walk_counts&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_IN_BOUNDARY_H
