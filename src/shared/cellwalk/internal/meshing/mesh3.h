// SPDX-License-Identifier: GPL-3.0-or-later
// Well-shaped tetrahedra in the interior of a closed surface, which is approximated, by CGAL's Mesh_3.
#ifndef CELLWALK_INTERNAL_MESHING_MESH3_H
#define CELLWALK_INTERNAL_MESHING_MESH3_H

#include <cellwalk/meshing/mesher_limits.h>
#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace cellwalk {

/// Lengths are in units of the surface; 0 selects the default.
struct Mesh3_options {
  double cell_size = 0;       ///< bound of circumradii; default a twentieth of the bounding box's diagonal
  double facet_size = 0;      ///< bound of surface triangles' radii; default cell_size
  double facet_distance = 0;  ///< bound of their distance to the surface; default a fiftieth of facet_size
  double facet_angle = 25;    ///< degrees, at most 30
  double radius_edge = 2;     ///< bound of circumradius to shortest edge, at least 2
  /// Names of the obstacles in messages; default: "obstacle 1", ...
  std::vector<std::string> obstacle_names{};
  Mesher_limits limits{};
};

struct Mesh3_report {
  Surface_report surface;
  std::vector<Surface_report> obstacles;
  std::size_t boundary_facets = 0;
  /// The largest distance found from the mesh's boundary to the surfaces (at its vertices, edge midpoints and
  /// facet centroids) and from the surfaces' vertices to the mesh's boundary.
  double distance_to_surface = 0, distance_from_surface = 0;
};

/// Fills the interior of a closed surface, without that of the obstacles, with tetrahedra.
/// \throw Error(input) as tetrahedralize; Error(usage) for options out of range: sizes that need more than
///        10^8 cells or facets of any shape, and distances below 2^-20 of the bounding box's diagonal
/// \throw Error(not_certified) if the mesh has no tetrahedron (sizes too large for the surface), or a flat
///        one; if Mesh_3 fails or crashes, or does not end in time: and where the surface is narrowest.
///        Mesh_3 runs in a process of its own, which has ended by then.
///
/// The same input gives the same mesh.
/// Cost: about 30 us a tetrahedron.
Cell_soup<3> mesh3(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles = {},
                   const Mesh3_options& options = {}, Mesh3_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_MESHING_MESH3_H
