// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets with points near their sides as triangles. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_BENT_FACETS_H
#define CELLWALK_ENVIRONMENT_REFINE_BENT_FACETS_H

#include <cellwalk/kernel/point.h>

#include <span>
#include <vector>

#include "environment/certify/boundary_facet.h"

namespace cellwalk::detail {

/// Divides a facet that has vertices near the line between their neighbours, but not on it, into triangles
/// none of which is as flat: a wall with a flat one could turn any way, and into another cell. Both sides of
/// a facet are divided alike.
/// \param tolerance what is near
/// \return nothing for other facets, and for those that are not convex
std::vector<Facet_loop> triangles_of_bent(std::span<const Point<3>> points, const Facet_loop& loop,
                                          double tolerance);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_BENT_FACETS_H
