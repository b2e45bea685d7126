// SPDX-License-Identifier: LGPL-3.0-or-later
// The motion of a wall against a feature that stands still is that of an edge (2D) or a face of a body
// against a wall of so many corners.
#include <cellwalk/internal/edge/thick_wall.h>

#include <tuple>

#include "near_normal.h"
#include "near_time.h"

namespace cellwalk::detail {

template <int D>
bool is_before(const Thick_meeting<D>& x, const Thick_meeting<D>& y) {
  if (const auto order = x.time <=> y.time; order != 0) return order < 0;
  return std::tie(x.of_feature.size, x.of_wall.size) < std::tie(y.of_feature.size, y.of_wall.size);
}

template <int D>
std::optional<Thick_meeting<D>> first_meeting(
    const std::array<Point<D>, static_cast<std::size_t>(D) + 1>& swept, std::span<const Point<D>> feature,
    double r, const std::optional<Exact_time>& known) {
  Thick_motion<D> motion{swept[0], swept[1], swept[2], r};
  if constexpr (D == 3) motion.third = swept[3];
  if (known && is_later<D>(motion, feature, known->rounded())) return {};
  const Near_time near = find_near_time<D>(motion, feature, approximate_near_time<D>(motion, feature));
  Thick_meeting<D> meeting{to_time(near.root), near.of_motion, near.of_wall};
  const Near_place<D> place = find_near_place<D>(motion, feature, near, meeting.time.rounded());
  meeting.on_wall = place.on_motion;
  meeting.on_feature = place.on_wall;
  meeting.normal = -1.0 * place.normal + Vector<D>{};
  return meeting;
}

#define CELLWALK_INSTANTIATE(D)                                                                \
  template bool is_before(const Thick_meeting<D>&, const Thick_meeting<D>&);                   \
  template std::optional<Thick_meeting<D>> first_meeting(const std::array<Point<D>, (D) + 1>&, \
                                                         std::span<const Point<D>>, double,    \
                                                         const std::optional<Exact_time>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
