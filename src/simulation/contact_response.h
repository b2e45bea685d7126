// SPDX-License-Identifier: LGPL-3.0-or-later
// How contacts change the velocities of a deformable body. No answer adds energy.
#ifndef CELLWALK_SIMULATION_CONTACT_RESPONSE_H
#define CELLWALK_SIMULATION_CONTACT_RESPONSE_H

#include <cellwalk/body/body.h>

#include <span>

#include "rigid_motion.h"

namespace cellwalk::detail {

/// How walls answer a body.
struct Answer {
  double restitution = 1;  ///< share of the speed against the wall that is kept
  double friction = 0;     ///< share of the speed along the wall that is lost, once at each contact
  double resting = 0;      ///< slower than this against the wall there is no bounce
  /// How far the whole body answers a contact, in [0,1]; the rest is up to the vertices that met the wall.
  double stiffness = 1;
};

/// Changes velocities so that nothing that met a wall goes on into it.
///
/// Each contact is an impulse at the place where the body met the wall: with mobility K = a P + (1 - a) I, a the stiffness and P the
/// projection on rigid motions, velocities change by K c j, c being the normal at that place. Since K >= K^2, an impulse that
/// turns a speed round or takes part of it away never adds energy; with restitution 1, no friction and a = 1 it takes none away.
/// \pre contacts are of this body, velocities are finite
template <int D>
void answer_contacts(const Body<D>& body, std::span<const Body_contact<D>> contacts, const Answer& answer,
                     std::span<Vector<D>> velocities);

extern template void answer_contacts<2>(const Body<2>&, std::span<const Body_contact<2>>, const Answer&,
                                        std::span<Vector<2>>);
extern template void answer_contacts<3>(const Body<3>&, std::span<const Body_contact<3>>, const Answer&,
                                        std::span<Vector<3>>);

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_CONTACT_RESPONSE_H
