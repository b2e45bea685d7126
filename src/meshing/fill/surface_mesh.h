// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces as CGAL's mesh, shared by the sources of this component.
#ifndef CELLWALK_MESHING_FILL_SURFACE_MESH_H
#define CELLWALK_MESHING_FILL_SURFACE_MESH_H

#include <cellwalk/meshing/tetrahedralize.h>
#include <cellwalk/records/surface_soup.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "feature_names.h"
#include "surface_topology.h"

namespace cellwalk::detail {

using Mesh_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface_mesh = CGAL::Surface_mesh<Mesh_kernel::Point_3>;

/// Appends a surface to a mesh; faces are numbered in the order of the facets.
/// \pre the surface is an oriented manifold
void append(Surface_mesh& mesh, const Surface_soup& surface);

/// Pairs of faces that meet elsewhere than in a common edge or vertex, each pair ascending, all in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> intersecting_faces(const Surface_mesh& mesh);

/// check_surface(), with the vertex and facet of the input that each is or comes from.
Traced_surface check_traced(const Surface_soup& soup, const std::string& name, Surface_report& report);

/// Surfaces that may be meshed, as triangles, and the names of their parts in messages.
struct Checked_surfaces {
  std::vector<Surface_soup> soups;
  Feature_names names;
};

/// Checks the surface, then its obstacles, and that they do not meet. Messages refer to obstacles by their
/// names, or by their numbers if they have none.
/// \throw Error(input)
Checked_surfaces check_apart(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                             const std::vector<std::string>& obstacle_names, Surface_report& surface_report,
                             std::vector<Surface_report>& obstacle_reports);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_SURFACE_MESH_H
