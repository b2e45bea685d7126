// SPDX-License-Identifier: LGPL-3.0-or-later
// Distances from parts of a scene, and the points in them.
#ifndef CELLWALK_INTERNAL_RECORDS_SCENE_SHAPE_H
#define CELLWALK_INTERNAL_RECORDS_SCENE_SHAPE_H

#include <cellwalk/internal/records/environment_change.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <variant>

namespace cellwalk::detail {

template <int D>
double distance(const Scene_box<D>& box, const Point<D>& x) {
  Vector<D> off{};
  for (std::size_t k = 0; k < D; ++k) off[k] = std::max({box.lower[k] - x[k], 0.0, x[k] - box.upper[k]});
  return length(off);
}

template <int D>
double distance(const Scene_ball<D>& ball, const Point<D>& x) {
  return std::max(0.0, length(x - ball.centre) - ball.radius);
}

/// From the nearest of them; infinite if there are none.
template <int D>
double distance(std::span<const Scene_shape<D>> shapes, const Point<D>& x) {
  double result = std::numeric_limits<double>::infinity();
  for (const Scene_shape<D>& shape : shapes)
    result = std::min(result, std::visit([&](const auto& s) { return distance<D>(s, x); }, shape));
  return result;
}

/// True if a part has no shape, or a point lies in it.
template <int D>
bool is_in_shape(const Environment_part<D>& part, const Point<D>& x) {
  return !part.shape || distance<D>(std::span<const Scene_shape<D>>(&*part.shape, 1), x) == 0;
}

template <int D>
bool is_in_front(const Scene_plane<D>& plane, const Point<D>& x) {
  return dot(x - plane.point, plane.normal) > 0;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_RECORDS_SCENE_SHAPE_H
