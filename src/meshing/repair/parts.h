// SPDX-License-Identifier: GPL-3.0-or-later
// Caps, mouths and sheets: their numbers, sizes and names.
#ifndef CELLWALK_MESHING_REPAIR_PARTS_H
#define CELLWALK_MESHING_REPAIR_PARTS_H

#include <cellwalk/internal/meshing/repair_surface.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "facets.h"

namespace cellwalk::detail {

/// The name of a cap, mouth or sheet by its number.
using Part_names = std::map<std::pair<Part, std::uint32_t>, std::string>;

/// Numbers triangles of sheets or mouths, those connected by edges alike.
/// \return how many there are
std::uint32_t number_connected(std::vector<Facet>& facets, Part part);

/// Lists and names what the walls have of caps, mouths and sheets, each kind by descending area.
/// \param points,walls of the result, seen from the free space
/// \param caps as add_caps() returned them
std::pair<std::vector<Repaired_part>, Part_names> name_parts(const std::vector<Point<3>>& points,
                                                             std::span<const Facet> walls,
                                                             const std::vector<Repaired_part>& caps);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_PARTS_H
