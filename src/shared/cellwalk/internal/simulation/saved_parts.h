// SPDX-License-Identifier: LGPL-3.0-or-later
// The one friend of simulated things: it saves and restores their state, see saved_state.h.
#ifndef CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H
#define CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H

namespace cellwalk::detail {

template <int D>
class State_access;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H
