// SPDX-License-Identifier: LGPL-3.0-or-later
// A contact as a run reports it.
#ifndef CELLWALK_SIMULATION_CONTACT_RECORD_H
#define CELLWALK_SIMULATION_CONTACT_RECORD_H

#include <cellwalk/edge/contact.h>

#include <cstdint>
#include <optional>

namespace cellwalk {

/// Whose feature met a wall, if it was a body's.
struct Met_body {
  std::uint32_t body = 0;    ///< its number in the run
  std::uint32_t vertex = 0;  ///< the one that was moving
  std::uint32_t number = 0;  ///< of the vertex, edge or face that met the wall
};

/// A particle or a body was stopped by a wall.
template <int D>
struct Contact_record {
  std::uint32_t step = 0;      ///< counted from 1
  std::uint32_t particle = 0;  ///< its number in the run; of no meaning where a body is met
  /// Its time, of particles: share of the step that had passed. Of bodies: share of the vertex's motion that was free; what is left of
  /// it after a contact is a motion of its own.
  Contact<D> contact;
  std::uint32_t cell = 0;          ///< input index of the cell in which the motion ended
  std::optional<Met_body> body{};  ///< nothing: it was a particle
};

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_CONTACT_RECORD_H
