// SPDX-License-Identifier: LGPL-3.0-or-later
// A contact as a run reports it.
#ifndef CELLWALK_SIMULATION_CONTACT_RECORD_H
#define CELLWALK_SIMULATION_CONTACT_RECORD_H

#include <cellwalk/walk/walk.h>

#include <cstdint>

namespace cellwalk {

/// A particle was stopped by a wall.
template <int D>
struct Contact_record {
  std::uint32_t step = 0;      ///< counted from 1
  std::uint32_t particle = 0;  ///< its number in the run
  double time = 0;             ///< share of the step that had passed, in [0,1]
  Point<D> point{};            ///< where the motion met the wall, rounded
  Vector<D> normal{};          ///< unit normal of the wall, towards the free side
  Contact_kind kind = Contact_kind::facet;
  std::uint32_t cell = 0;  ///< input index of the cell in which the motion ended
};

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_CONTACT_RECORD_H
