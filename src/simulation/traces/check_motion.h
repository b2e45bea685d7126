// SPDX-License-Identifier: LGPL-3.0-or-later
// What moves faster than numbers go is refused, and not led on with infinities.
#ifndef CELLWALK_SIMULATION_TRACES_CHECK_MOTION_H
#define CELLWALK_SIMULATION_TRACES_CHECK_MOTION_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace cellwalk::detail {

[[noreturn]] inline void refuse_motion(const std::string& whose) {
  throw Error(Error_code::input, whose + " is not finite: take a smaller time step, or slower motion");
}

/// \param motion where vertices go, or how fast
/// \throw Error(input) naming the first vertex that goes nowhere
template <std::size_t D>
void check_motion(std::span<const std::array<double, D>> motion) {
  const auto lost = std::ranges::find_if_not(motion, is_finite<D>);
  if (lost != motion.end()) refuse_motion("the motion of vertex " + std::to_string(lost - motion.begin()));
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_TRACES_CHECK_MOTION_H
