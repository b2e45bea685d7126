// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts in the report of a run.
#ifndef CELLWALK_INTERNAL_SIMULATION_RUN_CONTACT_H
#define CELLWALK_INTERNAL_SIMULATION_RUN_CONTACT_H

#include <cellwalk/walk/contact.h>

#include <cstdint>
#include <optional>

namespace cellwalk {

/// A row in the report of a run: a contact, with the step and the particle or body that it belongs to.
template <int D>
struct Run_contact {
  std::uint32_t step = 0;      ///< counted from 1
  std::uint32_t particle = 0;  ///< its number in the run; meaningless for bodies
  /// For particles, its time is the fraction of the step that had passed; for bodies, the fraction of the
  /// vertex's motion that was free, where the rest of the motion after a contact counts as a motion of its
  /// own. In the replay of a trace it is that of Rejected_move.
  Contact<D> contact;
  std::uint32_t cell = 0;               ///< input index of the cell in which the motion ended
  std::optional<std::uint32_t> body{};  ///< its number in the run; none: a particle
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_RUN_CONTACT_H
