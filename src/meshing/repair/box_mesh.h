// SPDX-License-Identifier: GPL-3.0-or-later
// Tetrahedra between the triangles of a surface and a box around it, and the regions that they form.
#ifndef CELLWALK_MESHING_REPAIR_BOX_MESH_H
#define CELLWALK_MESHING_REPAIR_BOX_MESH_H

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "changes.h"
#include "facets.h"
#include "meshing/fill/tetgen_call.h"

namespace cellwalk::detail {

/// The source of each triangle of a mesh, by its points in ascending order. Of triangles in the same place,
/// that of the lowest part.
using Labels = std::unordered_map<Triangle, Facet, Triangle_hash>;
Labels labels_of(const std::vector<Facet>& facets);

/// Leaves out points of no triangle.
void compact(Facets& surface);

enum class Frame { none, box };

/// Tetrahedra that conform to the triangles, in their hull, or in a box half as large again.
/// \pre the triangles do not cross
/// \param tolerance receives the reason for another tolerance than TetGen's own, if there is one
/// \throw Error as mesh_by_tetgen()
Tetgen_result mesh_between(const Facets& surface, Frame frame, const Tetrahedralize_options& options,
                           std::string& tolerance);

double volume_of(const Tetgen_result& mesh, std::uint32_t tetrahedron);
Point<3> centre_of(const Tetgen_result& mesh, std::uint32_t tetrahedron);

/// Tetrahedra connected through facets of no triangle.
struct Region {
  double volume = 0;
  std::array<std::uint32_t, 2> largest{};  ///< its two largest tetrahedra; the same for a single one
  bool is_outer = false;                   ///< reaches the hull of the mesh
};

struct Regions {
  std::vector<std::uint32_t> of;  ///< per tetrahedron
  std::vector<Region> regions;
};

Regions find_regions(const Tetgen_result& mesh, const Labels& labels);

/// The winding number of each region.
struct Windings {
  std::vector<double> of;
  double error = 0;          ///< the largest distance from an integer
  double volume = 0;         ///< each region's volume times its winding number
  double covered_twice = 0;  ///< the same for its part above 1
  Found inside_out;          ///< regions whose numbers are below -1/2
  double inside_out_volume = 0;
};

/// \param oriented the triangles that bound regions
/// \param hint the end of the message about a leak
/// \throw Error(input) if two places of a region have different ones
/// Cost: two winding numbers for each region.
Windings wind(const Tetgen_result& mesh, const Regions& regions, const Facets& oriented,
              const std::string& hint);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_BOX_MESH_H
