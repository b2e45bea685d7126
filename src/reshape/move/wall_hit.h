// SPDX-License-Identifier: LGPL-3.0-or-later
// The report of a hit.
#ifndef CELLWALK_RESHAPE_MOVE_WALL_HIT_H
#define CELLWALK_RESHAPE_MOVE_WALL_HIT_H

#include <cellwalk/internal/edge/moving_star.h>
#include <cellwalk/reshape/move.h>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// \param collision of a wall of the star with a member of a group
template <int D>
Wall_hit<D> to_wall_hit(const Collision& collision, const Moving_star<D>& star,
                        const Resident_groups<D>& groups);

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_MOVE_WALL_HIT_H
