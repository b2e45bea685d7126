// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces and polygons as read from files: the input of meshing.
#ifndef CELLWALK_RECORDS_SURFACE_SOUP_H
#define CELLWALK_RECORDS_SURFACE_SOUP_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// A polygon soup in 3D. A facet is a loop of point indices; the facets of a closed surface are
/// counterclockwise seen from outside.
struct Surface_soup {
  std::vector<Point<3>> points;
  std::vector<std::vector<std::uint32_t>> facets;
};

/// Facets of a surface that lie within the space that it bounds, or are given on both sides: membranes,
/// nothing, or a reason to refuse the surface.
enum class Sheets { keep, open, refuse };

/// How a surface is understood that is open, crosses itself or is not manifold. Distances are parts of its
/// size, the diagonal of the box around it.
struct Repair_options {
  double seam = 1e-5;      ///< points on borders nearer than this become one; 0: never
  double weld = 1e-7;      ///< any points nearer than this, if no mesher takes them apart; 0: never
  double max_move = 1e-3;  ///< the farthest that walls may lie from the surface, caps and mouths aside
  /// Points in the free space; empty: it is what the surface encloses, or the lumen of a thick wall.
  std::vector<Point<3>> inside{};
  bool is_solid = false;  ///< it is what the surface encloses, even if that is a thick wall around a lumen
  Sheets sheets = Sheets::keep;
};

/// A planar domain: straight segments, which bound the domain and its obstacles, and one point in each hole.
/// Each segment becomes a wall.
struct Planar_domain {
  std::vector<Point<2>> points;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<Point<2>> holes;
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_SURFACE_SOUP_H
