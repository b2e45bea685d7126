// SPDX-License-Identifier: GPL-3.0-or-later
// Points that become one: those of seams, and those that rounding left almost in the same place.
#ifndef CELLWALK_MESHING_REPAIR_NEAR_POINTS_H
#define CELLWALK_MESHING_REPAIR_NEAR_POINTS_H

#include "changes.h"
#include "facets.h"

namespace cellwalk::detail {

/// Joins points of the border that are nearer to each other than `distance`, unless an edge joins them.
/// \param distance in units of the surface
/// \return the points that moved
Found join_seams(Facets& surface, double distance);

/// Joins points nearer to each other than `distance`. Of a point of the file and one that was made, that of
/// the file stays.
/// \param also_given true: also two points of the file
/// \return the points that moved
Found weld(Facets& surface, double distance, bool also_given);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_NEAR_POINTS_H
