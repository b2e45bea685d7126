// SPDX-License-Identifier: GPL-3.0-or-later
// Caps over the holes of a surface.
#ifndef CELLWALK_MESHING_REPAIR_CAPS_H
#define CELLWALK_MESHING_REPAIR_CAPS_H

#include <cellwalk/internal/meshing/repair_surface.h>

#include <vector>

#include "facets.h"

namespace cellwalk::detail {

/// Fills each cycle of edges with an odd number of triangles, with the orientation of its neighbours. Cycles
/// whose points lie on one line are closed already.
/// \param surface receives triangles of caps, numbered as the result is; a point for each cap that has too
///        many edges for a triangulation
/// \return the caps, by descending area, without names of triangles
/// Degenerate cases: a cycle that passes a point twice is two cycles.
std::vector<Repaired_part> add_caps(Facets& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_CAPS_H
