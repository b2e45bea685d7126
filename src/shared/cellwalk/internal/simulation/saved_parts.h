// SPDX-License-Identifier: LGPL-3.0-or-later
// What may read and write all parts of the state of a simulation, see saved_state.h.
#ifndef CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H
#define CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H

namespace cellwalk::detail {

class Byte_reader;
class Byte_writer;
template <int D>
class Saved_simulation;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_SIMULATION_SAVED_PARTS_H
