// SPDX-License-Identifier: GPL-3.0-or-later
// Tetrahedra in the interior of a closed surface, which is preserved exactly, by TetGen.
#ifndef CELLWALK_MESHING_TETRAHEDRALIZE_H
#define CELLWALK_MESHING_TETRAHEDRALIZE_H

#include <cellwalk/meshing/mesher_limits.h>
#include <cellwalk/records/cell_soup.h>
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

struct Tetrahedralize_options {
  /// Bound of the ratio of a tetrahedron's circumradius to its shortest edge, at least 1.1; 0: none, and no
  /// point is added that is not necessary. Points are added in the interior only, so the bound may be
  /// violated near the surface. With the default, edges lie in the fewest tetrahedra, or nearly so
  /// (docs/commands.md, import).
  double quality = 3;
  /// No tetrahedron has a larger volume than a regular one of this circumradius, in units of the surface; 0:
  /// any. Where facets of the surface are larger, so are tetrahedra.
  double cell_size = 0;
  std::size_t most_added_points = 1000000;  ///< refinement stops there
  /// True: obstacles are kept as solid cells; false: they are omitted
  bool keep_obstacles = false;
  /// Names of the obstacles in messages; default: "obstacle 1", ...
  std::vector<std::string> obstacle_names{};
  Mesher_limits limits{};
};

struct Tetrahedralize_report {
  Surface_report surface;
  std::vector<Surface_report> obstacles;
  std::size_t added_points = 0;     ///< in the interior; none on the surface
  std::size_t boundary_facets = 0;  ///< triangles of the surface and the obstacles, all preserved
  std::size_t solid_cells = 0;      ///< with keep_obstacles
  std::size_t out_of_bounds = 0;    ///< tetrahedra that violate the bounds of quality and size
  /// Why a tolerance finer than TetGen's own was necessary, and where; empty if it was not
  std::string tolerance;
};

/// True if there is TetGen: a program cellwalk-tetgen that belongs to the library (docs/embedding.md).
bool has_tetgen();

/// Fills the interior of a closed surface, without that of the obstacles, with tetrahedra. Every triangle of
/// a surface is a facet of the result and a wall. A point is inside if an odd number of components of the
/// surface enclose it.
/// \throw Error(input) if a surface fails check_surface, or an obstacle does not lie inside the surface and
///        apart from it and from the other obstacles
/// \throw Error(usage) for options out of range, for a cell size that needs more than ten tetrahedra for each
///        of the added points, or if there is no TetGen
/// \throw Error(not_certified) if TetGen fails or crashes, does not end in time, does not preserve the
///        surface, or makes a flat tetrahedron, with each of its tolerances: the first problem, and where the
///        surface is narrowest. TetGen runs in a process of its own, which has ended by then.
/// Cost: about 20 us a tetrahedron.
Cell_soup<3> tetrahedralize(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles = {},
                            const Tetrahedralize_options& options = {},
                            Tetrahedralize_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_MESHING_TETRAHEDRALIZE_H
