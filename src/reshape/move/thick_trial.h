// SPDX-License-Identifier: LGPL-3.0-or-later
// The decision whether walls that move keep their distance from residents with a radius. Theory:
// docs/radius.md, walls that move.
#ifndef CELLWALK_RESHAPE_MOVE_THICK_TRIAL_H
#define CELLWALK_RESHAPE_MOVE_THICK_TRIAL_H

#include <cellwalk/internal/edge/moving_star.h>
#include <cellwalk/reshape/move.h>

#include <optional>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// The first time at which a wall of a star comes as near to a resident as its radius, and would come nearer;
/// none if all keep their distance.
/// \param any if true, the first obstruction found will do, and it is not located
template <int D>
std::optional<Wall_hit<D>> first_near_hit(const Moving_star<D>& star, Resident_groups<D>& groups, bool any);

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_MOVE_THICK_TRIAL_H
