// SPDX-License-Identifier: LGPL-3.0-or-later
// The place and the normal of a contact of something with a radius.
#ifndef CELLWALK_EDGE_THICK_NEAR_NORMAL_H
#define CELLWALK_EDGE_THICK_NEAR_NORMAL_H

#include "near_time.h"

namespace cellwalk::detail {

template <int D>
struct Near_place {
  Point<D> on_motion, on_wall;  ///< rounded
  Vector<D> normal;             ///< from the wall to what moves; of length 1, against the motion
};

/// \param time that of `near`, rounded
/// Cost: ring numbers where the radius is less than 2^-12 of the differences of coordinates.
template <int D>
Near_place<D> find_near_place(const Thick_motion<D>& motion, std::span<const Point<D>> wall,
                              const Near_time& near, double time);

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_NORMAL_H
