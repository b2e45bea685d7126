// SPDX-License-Identifier: GPL-3.0-or-later
// The conditions on a closed surface for meshing, and the corrections made before.
#ifndef CELLWALK_MESHING_SURFACE_CHECK_H
#define CELLWALK_MESHING_SURFACE_CHECK_H

#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace cellwalk {

/// Everything that checking a surface changed. Nothing is repaired silently.
struct Surface_report {
  std::size_t points_read = 0, facets_read = 0;
  std::size_t merged_points = 0;        ///< points with the coordinates of another one
  std::size_t unused_points = 0;        ///< points of no facet, dropped
  std::size_t collapsed_facets = 0;     ///< dropped: fewer than three different vertices are left
  std::size_t triangulated_facets = 0;  ///< polygons with more than three vertices, split into triangles
  std::size_t turned_facets = 0;        ///< facets that were reoriented to agree with their neighbours
  bool inside_out = false;              ///< all facets were oriented inwards, and were reoriented
  std::size_t components = 0;           ///< closed surfaces
  double volume = 0;                    ///< enclosed; rounded
};

/// One line for each change.
std::vector<std::string> describe(const Surface_report& report);

/// Checks that a surface is a closed, orientable 2-manifold without self-intersections, and returns it as
/// triangles, oriented so that they bound a volume (nested components alternate). Merges points of equal
/// coordinates, drops facets that collapse, splits polygons into triangles, and orients all facets.
/// \param name the name of the surface in messages, such as "surface" or "obstacle 2"
/// \throw Error(input) with the first violation of: empty, an index out of range, a coordinate not finite,
///        open, non-manifold edges, degenerate facets, not orientable, non-manifold vertices,
///        self-intersections; with their number, the first place (vertices and facets by their number in the
///        input, from 0), and the remedy
/// Degenerate cases: a facet with collinear vertices only is refused; components that touch count as
/// self-intersections.
/// Cost: about 10 us a triangle.
Surface_soup check_surface(const Surface_soup& soup, const std::string& name = "surface",
                           Surface_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_MESHING_SURFACE_CHECK_H
