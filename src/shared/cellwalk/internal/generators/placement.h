// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether a lattice that is placed keeps exactly planar facets.
#ifndef CELLWALK_INTERNAL_GENERATORS_PLACEMENT_H
#define CELLWALK_INTERNAL_GENERATORS_PLACEMENT_H

#include <cellwalk/generators/lattice_map.h>

#include <array>
#include <cstdint>

namespace cellwalk {

/// The condition on the image of a lattice.
enum class Placement {
  planar,   ///< lattice planes stay exactly planar
  positive  ///< cells keep their orientation: enough for simplices
};

/// Checks the images of the lattice points 0 <= k[i] <= extent[i], k[i] multiples of 2^-binary_places.
/// Placement::planar requires that either no coordinate is rounded, or each coordinate depends on one axis
/// only (then rounding moves whole lattice planes) and neighbouring planes stay separate.
/// \throw Error(usage) if the condition fails, or if the map is singular or a reflection
template <int D>
void check_placement(const Lattice_map<D>& map, const std::array<std::uint32_t, D>& extent, int binary_places,
                     Placement placement);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_GENERATORS_PLACEMENT_H
