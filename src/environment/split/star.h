// SPDX-License-Identifier: LGPL-3.0-or-later
// The cut of a polyhedron with triangular facets into the star of one point. Internal to splitting.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_STAR_H
#define CELLWALK_ENVIRONMENT_SPLIT_STAR_H

#include <span>

#include "polygon.h"

namespace cellwalk::detail {

/// The apex of the star of a polyhedron.
struct Star {
  bool found = false;
  bool is_vertex = false;
  std::uint32_t vertex = 0;  ///< if it is a vertex of the polyhedron
  Point<3> point{};          ///< otherwise: a point inside
};

/// Finds the lowest vertex, otherwise an interior point, from which the tetrahedra over the triangles are all
/// exactly positive and do not overlap. The interior points tried are the mean of the vertices, the mean of
/// the triangles, and the middle of the kernel, if there are at most 96 triangles.
/// \pre the triangles form a closed surface, counterclockwise seen from outside
Star find_star(Predicate_counts& counts, std::span<const Point<3>> points, const Triangulation& surface);

/// The middle of the kernel, the set of points that see all triangles from inside, in rounded arithmetic: a
/// candidate that must be checked. False if none was found.
bool middle_of_kernel(std::span<const Point<3>> points, const Triangulation& surface, Point<3>& middle);

/// The enclosed volume, rounded; negative if the triangles face inwards.
double enclosed_volume(std::span<const Point<3>> points, const Triangulation& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SPLIT_STAR_H
