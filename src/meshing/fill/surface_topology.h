// SPDX-License-Identifier: GPL-3.0-or-later
// The combinatorial half of checking a surface: points, edges, orientation. Not by CGAL's
// orient_polygon_soup(), which duplicates points of surfaces that are not manifold instead of refusing them.
#ifndef CELLWALK_MESHING_FILL_SURFACE_TOPOLOGY_H
#define CELLWALK_MESHING_FILL_SURFACE_TOPOLOGY_H

#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/records/surface_soup.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::detail {

/// A surface during its correction, with the origins of its parts.
struct Traced_surface {
  Surface_soup soup;
  std::vector<std::uint32_t> input_point;  ///< per point: the first one at its position in the input
  std::vector<std::uint32_t> input_facet;  ///< per facet
};

/// Merges points, drops unused ones and collapsed facets.
/// \throw Error(input) if the surface is empty or malformed
Traced_surface clean(const Surface_soup& soup, const std::string& name, Surface_report& report);

/// True if the exact points lie on one line.
bool is_on_one_line(const Point<3>& a, const Point<3>& b, const Point<3>& c);

/// Checks that the surface is closed, manifold and not degenerate, and reverses facets so that neighbours
/// agree.
/// \throw Error(input)
void make_oriented_manifold(Traced_surface& surface, const std::string& name, Surface_report& report);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_SURFACE_TOPOLOGY_H
