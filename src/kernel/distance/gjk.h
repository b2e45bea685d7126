// SPDX-License-Identifier: LGPL-3.0-or-later
// The method of Gilbert, Johnson and Keerthi (IEEE Journal of Robotics and Automation 4(2), 1988): a walk on
// the differences of the points of two hulls towards the one that is nearest to the origin. Here it stops as
// soon as the hulls are known to be nearer than r, or farther apart.
#ifndef CELLWALK_KERNEL_DISTANCE_GJK_H
#define CELLWALK_KERNEL_DISTANCE_GJK_H

#include "filter.h"

namespace cellwalk::detail {

enum class Gjk_answer { near, apart, open };

/// \param direction takes one along which the hulls are more than r apart, if they are
/// \return near or apart only if that is proven; open where rounding hides it
/// \pre filter.is_in_range()
template <int D>
Gjk_answer gjk(const Filter<D>& filter, std::span<const Point<D>> a, std::span<const Point<D>> b,
               Vector<D>& direction);

}  // namespace cellwalk::detail

#endif  // CELLWALK_KERNEL_DISTANCE_GJK_H
