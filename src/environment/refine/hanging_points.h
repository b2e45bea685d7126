// SPDX-License-Identifier: LGPL-3.0-or-later
// Vertices of facets inside sides of others. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_HANGING_POINTS_H
#define CELLWALK_ENVIRONMENT_REFINE_HANGING_POINTS_H

#include <span>
#include <vector>

#include "lone_facets.h"
#include "sides.h"

namespace cellwalk::detail {

/// Adds to each side of a facet the vertices of others that lie inside it, and the points inside their sides,
/// where pairs join the two facets, directly or through others. So sides that overlap in a line have the same
/// points there. With a tolerance this holds for all facets.
template <int D>
void add_hanging_points(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                        std::span<const Facet_pair> pairs, double tolerance, Sides<D>& sides);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_HANGING_POINTS_H
