// SPDX-License-Identifier: GPL-3.0-or-later
// The distance of two triangles that may share corners: rounded, to be shown.
#ifndef CELLWALK_MESHING_FILL_NARROW_DISTANCE_H
#define CELLWALK_MESHING_FILL_NARROW_DISTANCE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>

namespace cellwalk::detail {

using Triangle_corners = std::array<Point<3>, 3>;

struct Near_triangles {
  int common_corners = 0;
  double distance = 0;  ///< of the corners and edges that are not common
  Point<3> at{};
};

/// The distance of two points, without under- or overflow.
double apart(const Point<3>& a, const Point<3>& b);

/// The least distance of a corner of either to the other, common corners aside, and of their edges if they
/// share no corner. Three common corners: infinite.
/// \param a_names,b_names the corners, to see which are common
Near_triangles distance_of(const Triangle_corners& a, const Triangle_corners& b,
                           const std::array<std::size_t, 3>& a_names,
                           const std::array<std::size_t, 3>& b_names);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_NARROW_DISTANCE_H
