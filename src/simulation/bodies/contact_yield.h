// SPDX-License-Identifier: LGPL-3.0-or-later
// The yield of a wall that a contact with a body requires.
#ifndef CELLWALK_SIMULATION_BODIES_CONTACT_YIELD_H
#define CELLWALK_SIMULATION_BODIES_CONTACT_YIELD_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// Points and by how much they are to move; a point may occur several times.
template <int D>
using Yields = std::vector<std::pair<std::uint32_t, Vector<D>>>;

/// Adds the yields of the corners of the wall that a contact of the last step of a world requires: the wall
/// yields there by a share of the rest of the motion against it.
template <int D>
void add_yields(const Snapshot<D>& snapshot, const World<D>& world, const Run_contact<D>& met, double share,
                Yields<D>& yields);

extern template void add_yields(const Snapshot<2>&, const World<2>&, const Run_contact<2>&, double,
                                Yields<2>&);
extern template void add_yields(const Snapshot<3>&, const World<3>&, const Run_contact<3>&, double,
                                Yields<3>&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_CONTACT_YIELD_H
