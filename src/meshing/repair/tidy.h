// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles of a file, and those that stand for nothing left out.
#ifndef CELLWALK_MESHING_REPAIR_TIDY_H
#define CELLWALK_MESHING_REPAIR_TIDY_H

#include <cellwalk/records/surface_soup.h>

#include <vector>

#include "changes.h"
#include "facets.h"

namespace cellwalk::detail {

/// The facets of a surface as triangles. Points in the same place become one. Quadrangles are cut along the
/// shorter diagonal that folds them least, other polygons by a constrained triangulation.
/// \throw Error(input) if the surface is empty or malformed
Facets read_facets(const Surface_soup& surface, std::vector<Repair_change>& changes);

/// Leaves out triangles whose corners lie on one line, and repeated ones of the same orientation. Of repeated
/// ones with different parts, the part of lower value stays.
/// \return those left out, with their places
struct Left_out {
  Found collinear, repeated;
};
Left_out leave_out_useless(Facets& surface);

/// Replaces each point by another, and leaves out triangles that collapse.
/// \param target of each point; its own target is itself
void join_points(Facets& surface, const std::vector<std::uint32_t>& target);

/// Makes sheets of triangles that are given on both sides, where such a part has an edge of its own; other
/// such parts are the places where two solids touch.
/// \return the sheets found
Found find_doubled_sheets(Facets& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_TIDY_H
