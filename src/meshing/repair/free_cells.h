// SPDX-License-Identifier: GPL-3.0-or-later
// The free part of a mesh: its walls and its cells.
#ifndef CELLWALK_MESHING_REPAIR_FREE_CELLS_H
#define CELLWALK_MESHING_REPAIR_FREE_CELLS_H

#include <cellwalk/internal/meshing/repair_surface.h>

#include <vector>

#include "box_mesh.h"
#include "changes.h"
#include "facets.h"
#include "parts.h"

namespace cellwalk::detail {

/// Tetrahedra, of which some are free, among triangles.
struct Free_space {
  Tetgen_result mesh;
  Labels labels;
  std::vector<bool> is_free;  ///< per tetrahedron
  /// Triangles of the surface with free space on both sides are membranes; false: they are opened, as parts
  /// of the surface overlap there
  bool keeps_inner = false;
};

/// Makes components that are tiny beside the largest one unfree.
/// \return as count their number, as measured their volume over that of the largest one
Found leave_out_small(Free_space& space);

/// The triangles between free space and the rest, seen from the free space, and membranes, seen from one
/// side.
std::vector<Facet> walls_of(const Free_space& space);

/// Triangles of the surface with free space on both sides that are no walls.
Found opened_facets(const Free_space& space);

double free_volume(const Free_space& space);

/// The cells, with the facets of each named part in a group.
Repaired_surface cells_of(const Free_space& space, const Part_names& names);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_FREE_CELLS_H
