// SPDX-License-Identifier: GPL-3.0-or-later
// Patches: triangles connected by edges with two of them. Their orientation, and those that are sheets.
#ifndef CELLWALK_MESHING_REPAIR_PATCHES_H
#define CELLWALK_MESHING_REPAIR_PATCHES_H

#include <cstdint>
#include <utility>
#include <vector>

#include "changes.h"
#include "facets.h"

namespace cellwalk::detail {

struct Turned {
  Found facets;     ///< turned
  Found one_sided;  ///< edges at which a patch cannot agree with itself
};

/// Turns triangles so that neighbours in a patch agree: of each patch the smaller part.
Turned turn_to_agree(Facets& surface);

struct Oriented {
  bool inside_out = false;  ///< every triangle was turned
  Found facets;             ///< else those turned
  Found uneven;             ///< edges at which the directions of several patches do not cancel
};

/// Turns whole components, which are connected by points, so that they bound a volume: those in an even
/// number of others outwards, the others inwards. Components that cross others are turned outwards.
/// \param crossing pairs of triangles that cross
Oriented orient_by_nesting(Facets& surface,
                           const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing);

/// Makes sheets of patches that end within the space that the others bound.
/// \return the triangles found
/// Cost: 9 winding numbers for each patch with a border, at most ten seconds
Found find_inner_sheets(Facets& surface);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_PATCHES_H
