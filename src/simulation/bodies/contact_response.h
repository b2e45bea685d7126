// SPDX-License-Identifier: LGPL-3.0-or-later
// How contacts change the velocities of a deformable body.
#ifndef CELLWALK_SIMULATION_BODIES_CONTACT_RESPONSE_H
#define CELLWALK_SIMULATION_BODIES_CONTACT_RESPONSE_H

#include <cellwalk/body/body.h>

#include <span>

#include "rigid_motion.h"

namespace cellwalk::detail {

/// How walls answer a body.
struct Answer {
  double restitution = 1;  ///< share of the speed against the wall that is kept
  double friction = 0;     ///< share of the speed along the wall that is lost, once at each contact
  double resting = 0;      ///< a body that walls give no more than this impulse does not bounce
  /// How far the whole body answers a contact, in [0,1]; the rest is up to the vertices that met the wall.
  double stiffness = 1;
};

/// Changes velocities so that nothing that met a wall goes on into it.
///
/// Each contact is an impulse at the place where the body met the wall: with mobility a P + (1 - a) I, a the
/// stiffness and P the projection on rigid motions. First the impulses are found, none of them pulling, after
/// which no place goes into its wall (projected Gauss-Seidel); then friction acts where there is one; then
/// places that bounce get their share of the impulse once more (Moreau's rule). For a rigid body (a = 1)
/// without friction that keeps all energy with restitution 1, whatever the contacts. A deformable one may
/// gain a little from its deformation: the caller limits that.
/// \pre contacts are of this body, velocities are finite
/// Cost: some us, and 50 ns a contact and pass.
template <int D>
void answer_contacts(const Body<D>& body, std::span<const Contact<D>> contacts, const Answer& answer,
                     std::span<const Vector<D>> reached, std::span<Vector<D>> velocities);

extern template void answer_contacts<2>(const Body<2>&, std::span<const Contact<2>>, const Answer&,
                                        std::span<const Vector<2>>, std::span<Vector<2>>);
extern template void answer_contacts<3>(const Body<3>&, std::span<const Contact<3>>, const Answer&,
                                        std::span<const Vector<3>>, std::span<Vector<3>>);

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_CONTACT_RESPONSE_H
