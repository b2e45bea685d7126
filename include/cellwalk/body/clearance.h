// SPDX-License-Identifier: LGPL-3.0-or-later
// Body clearance: a ball free of walls, in which a body moves without tests. Theory: docs/sweep.md, clearance.
#ifndef CELLWALK_BODY_CLEARANCE_H
#define CELLWALK_BODY_CLEARANCE_H

#include <cellwalk/walk/walk.h>

#include <cstddef>
#include <optional>

namespace cellwalk {

/// An open ball in which all points are joined with its centre without a wall. Edits of the environment void it.
template <int D>
struct Clear_region {
  Particle<D> center;
  double squared_radius = 0;

  /// False where rounding leaves doubt.
  bool holds(const Point<D>& x) const {
    // Each of the at most D squares and D sums is rounded by one part in 2^53; the factor makes up for all of them.
    const Vector<D> d = x - center.position;
    return dot(d, d) * (1 + 0x1p-48) < squared_radius;
  }
};

/// The largest ball about a particle that a flood of at most `most_cells` cells proves free of walls, but at most of radius
/// `most`. Every distance is a lower bound, rounding included. None if it is no larger than `least`.
/// \pre 0 <= least < most, finite
/// Cost: about 50 ns a facet of the cells that the ball meets.
template <int D>
std::optional<Clear_region<D>> clear_region(const Snapshot<D>& snapshot, const Particle<D>& center,
                                            double least, double most, std::size_t most_cells = 256);

}  // namespace cellwalk

#endif  // CELLWALK_BODY_CLEARANCE_H
