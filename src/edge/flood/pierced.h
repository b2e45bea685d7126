// SPDX-License-Identifier: LGPL-3.0-or-later
// A wall that pierces a swept triangle blocks the edge that sweeps it: a certificate. Theory: docs/sweep.md,
// pierced triangles.
#ifndef CELLWALK_EDGE_FLOOD_PIERCED_H
#define CELLWALK_EDGE_FLOOD_PIERCED_H

#include <cellwalk/edge/swept_triangle.h>

namespace cellwalk::detail {

/// True proves that at some time in (0,1) the edge passes the interior of facet i of a cell from one side to
/// the other: a vertex (2D) or an edge (3D) of the facet passes the interior of the triangle, and q is not in
/// the plane of the facet. False is inconclusive. All signs are exact.
bool is_pierced(const Cell_view<2>& cell, std::size_t i, const Swept_triangle<2>& t, Walk_counts& counts);
bool is_pierced(const Cell_view<3>& cell, std::size_t i, const Swept_triangle<3>& t, Walk_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FLOOD_PIERCED_H
