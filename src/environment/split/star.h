// SPDX-License-Identifier: LGPL-3.0-or-later
// Cutting a polyhedron with triangular facets into the star of one point. Internal to splitting.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_STAR_H
#define CELLWALK_ENVIRONMENT_SPLIT_STAR_H

#include <span>

#include "polygon.h"

namespace cellwalk::detail {

/// The point that a polyhedron is cut from.
struct Star {
  bool found = false;
  bool is_vertex = false;
  std::uint32_t vertex = 0;  ///< if it is a vertex of the polyhedron
  Point<3> point{};          ///< otherwise: a point inside
};

/// Finds the lowest vertex, else an interior point, from which the tetrahedra over the triangles are all
/// exactly positive and do not overlap. Interior points tried: the mean of the vertices, the mean of the
/// triangles, and the middle of the kernel, where there are at most 96 triangles to search it by.
/// \pre the triangles form a closed surface, counterclockwise seen from outside
Star find_star(Predicate_counts& counts, std::span<const Point<3>> points, const Triangulation& surface);

/// The middle of the set of points that see all triangles from inside, as far as rounded arithmetic can tell:
/// a candidate, to be checked. False if none was found.
bool middle_of_kernel(std::span<const Point<3>> points, const Triangulation& surface, Point<3>& middle);

/// The enclosed volume, rounded; negative if the triangles face inwards.
double enclosed_volume(std::span<const Point<3>> points, const Triangulation& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SPLIT_STAR_H
