// SPDX-License-Identifier: GPL-3.0-or-later
// What a closed surface must be before its inside can be meshed, and what is put right on the way.
#ifndef CELLWALK_MESHING_SURFACE_CHECK_H
#define CELLWALK_MESHING_SURFACE_CHECK_H

#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace cellwalk {

/// Everything that checking a surface changed or noticed. Nothing is repaired silently.
struct Surface_report {
  std::size_t points_read = 0, facets_read = 0;
  std::size_t merged_points = 0;        ///< points with the coordinates of another one
  std::size_t unused_points = 0;        ///< points of no facet, dropped
  std::size_t collapsed_facets = 0;     ///< dropped: fewer than three different vertices are left
  std::size_t triangulated_facets = 0;  ///< polygons with more than three vertices, cut into triangles
  std::size_t turned_facets = 0;        ///< facets that had to be turned to agree with their neighbours
  bool inside_out = false;              ///< all facets looked inwards; all were turned
  std::size_t components = 0;           ///< closed surfaces
  double volume = 0;                    ///< enclosed; rounded
};

/// One line for each thing that was changed.
std::vector<std::string> describe(const Surface_report& report);

/// Checks that a surface is a closed, orientable 2-manifold without self-intersections, and returns it as triangles,
/// oriented so that they bound a volume (nested components alternate).
/// Merges points of equal coordinates, drops facets that this collapses, cuts polygons into triangles, and orients.
/// Messages call the surface by its name: "surface", "obstacle 2".
/// \throw Error(input) with the first reason of: empty, an index out of range, a coordinate not finite, open,
///        non-manifold edges, degenerate facets, not orientable, non-manifold vertices, self-intersections; how often,
///        where first (vertices and facets by their number in the input, from 0), and what to do
/// Degenerate cases: a facet with all vertices on one line is refused; components that touch are self-intersections.
/// Cost: about 10 us a triangle.
Surface_soup check_surface(const Surface_soup& soup, const std::string& name = "surface",
                           Surface_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_MESHING_SURFACE_CHECK_H
