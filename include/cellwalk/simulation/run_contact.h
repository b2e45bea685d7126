// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts in the report of a run.
#ifndef CELLWALK_SIMULATION_RUN_CONTACT_H
#define CELLWALK_SIMULATION_RUN_CONTACT_H

#include <cellwalk/edge/contact.h>

#include <cstdint>
#include <optional>

namespace cellwalk {

/// The feature of a body that met a wall.
struct Body_hit {
  std::uint32_t body = 0;    ///< its number in the run
  std::uint32_t vertex = 0;  ///< the moving vertex
  std::uint32_t number = 0;  ///< of the vertex, edge or face
};

/// A contact of a particle or a body with a wall.
template <int D>
struct Run_contact {
  std::uint32_t step = 0;      ///< counted from 1
  std::uint32_t particle = 0;  ///< its number in the run; meaningless for bodies
  /// For particles, its time is the fraction of the step that had passed; for bodies, the fraction of the
  /// vertex's motion that was free, where the rest of the motion after a contact counts as a motion of its
  /// own.
  Contact<D> contact;
  std::uint32_t cell = 0;          ///< input index of the cell in which the motion ended
  std::optional<Body_hit> body{};  ///< none: a particle
};

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_RUN_CONTACT_H
