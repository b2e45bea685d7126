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

/// Leaves out triangles whose corners lie on one line.
Found leave_out_collinear(Facets& surface);

/// Keeps one of the triangles in the same place, whatever their orientation: one whose part has the lowest
/// value.
void keep_one_in_each_place(Facets& surface);

struct Copies {
  Found repeated, sheets;
};

/// Decides about triangles of the file that are given twice, in connected parts. A part given on both sides,
/// with an edge of its own, is a sheet. Elsewhere one of two is left out if that closes the surface; where
/// two solids touch or overlap, both stay.
Copies settle_copies(Facets& surface);

/// Replaces each point by another, and leaves out triangles that collapse.
/// \param target of each point; its own target is itself
void join_points(Facets& surface, const std::vector<std::uint32_t>& target);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_TIDY_H
