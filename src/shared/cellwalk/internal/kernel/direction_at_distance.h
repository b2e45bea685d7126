// SPDX-License-Identifier: LGPL-3.0-or-later
// The direction between two hulls that are exactly a radius apart. Theory: docs/radius.md, faces and moving
// walls. Includes CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_DIRECTION_AT_DISTANCE_H
#define CELLWALK_INTERNAL_KERNEL_DIRECTION_AT_DISTANCE_H

#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <array>
#include <cstddef>
#include <optional>

namespace cellwalk::detail {

template <int D>
struct Direction_at_distance {
  std::array<Ring, static_cast<std::size_t>(D)> direction;  ///< from a to b, of any length
  std::size_t corner = 0;                                   ///< of a, the furthest along it
};

/// \param a,b,r as those of is_apart()
/// \return none if the distance is more or less than r
/// Cost: that of distance_bound() where it is more, all directions in ring numbers else.
template <int D>
std::optional<Direction_at_distance<D>> direction_at_distance(std::span<const Point<D>> a,
                                                              std::span<const Point<D>> b, double r);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_DIRECTION_AT_DISTANCE_H
