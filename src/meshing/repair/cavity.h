// SPDX-License-Identifier: GPL-3.0-or-later
// Lumens that a thick wall surrounds: where they are, and where they end.
#ifndef CELLWALK_MESHING_REPAIR_CAVITY_H
#define CELLWALK_MESHING_REPAIR_CAVITY_H

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "box_mesh.h"
#include "facets.h"

namespace cellwalk::detail {

/// A point in the lumen of a thick wall, if triangles form one: if many rays outwards from them meet them
/// again, farther than the wall is thick. The lumen has a winding number of 0 and may be open.
/// \pre triangles are oriented outwards
/// Cost: 0.5 s.
std::optional<Point<3>> find_lumen(const Facets& oriented);

/// The tetrahedra around some points, up to triangles and to mouths.
struct Cavity {
  std::vector<bool> is_inside;  ///< per tetrahedron
  std::vector<Facet> mouths;    ///< facets of the mesh, without numbers, seen from inside
};

/// Closes the ways out of a space near their narrowest places: tetrahedra are flooded from its points and
/// from the hull of the mesh, through the widest gates first, and mouths are the facets where both meet.
/// \param mesh of a box
/// \throw Error(input) if a point lies outside the box or beyond all mouths
/// Cost: that of sorting the tetrahedra.
Cavity close_cavity(const Tetgen_result& mesh, const Labels& labels, const std::vector<Point<3>>& inside);

/// The tetrahedron that contains a point, or the nearest one up to rounding. Cost: linear.
std::uint32_t locate(const Tetgen_result& mesh, const Point<3>& p);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_CAVITY_H
