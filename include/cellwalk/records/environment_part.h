// SPDX-License-Identifier: LGPL-3.0-or-later
// Parts of an environment, as boxes, balls and planes or by name.
#ifndef CELLWALK_RECORDS_ENVIRONMENT_PART_H
#define CELLWALK_RECORDS_ENVIRONMENT_PART_H

#include <cellwalk/kernel/point.h>

#include <optional>
#include <string>
#include <variant>

namespace cellwalk {

template <int D>
struct Scene_box {
  Point<D> lower{}, upper{};
};

template <int D>
struct Scene_ball {
  Point<D> centre{};
  double radius = 1;
};

/// A closed part of space.
template <int D>
using Scene_shape = std::variant<Scene_box<D>, Scene_ball<D>>;

/// A plane (2D: a line). A point x lies in front of it if (x - point) . normal > 0.
template <int D>
struct Scene_plane {
  Point<D> point{};
  Vector<D> normal{};
};

/// A part of an environment: a group, or all that fulfils the conditions given, at least one. A cell belongs
/// to it if the mean of its vertices lies in the shape and in front of the plane; a facet, if the mean of its
/// vertices lies in the shape, and the means of its two cells on either side of the plane. A stitch belongs
/// to it if the mean of its two points lies in the shape and in front of the plane.
template <int D>
struct Environment_part {
  std::string group;  ///< its name, here or in the file of the environment; empty: the conditions count
  std::optional<Scene_shape<D>> shape;
  std::optional<Scene_plane<D>> plane;
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_ENVIRONMENT_PART_H
