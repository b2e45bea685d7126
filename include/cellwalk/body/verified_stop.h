// SPDX-License-Identifier: LGPL-3.0-or-later
// Moving a particle among walls with a response: it stops at double positions that exact walks have
// confirmed.
#ifndef CELLWALK_BODY_VERIFIED_STOP_H
#define CELLWALK_BODY_VERIFIED_STOP_H

#include <cellwalk/edge/sweep.h>

#include <vector>

namespace cellwalk {

/// Moves a particle to a point near a contact for which the complete move from where it stands is found free.
/// Tried in this order, which is that of bodies: the exact contact point with each coordinate rounded up or
/// down, along the normal of the contact first; that point rounded towards where the particle stands, shifted
/// along the normal by 1, 2, 4 .. 1024 ulp of its largest coordinate; points on the way at (1 - 2^-k) times
/// the time of the contact, k = 20 .. 1; where it stands.
/// \param snapshot in which the particle lies
/// \param particle moved to the point that is found
/// \param target the end of the blocked move
/// \param contact the first one on the way to `target`, with its exact time
/// \param counts raised by the walks
/// \pre the contact comes from a move of this particle to `target`, see vertex_contact()
/// Returns true if the particle moved.
/// Cost: nearly always one walk, and some rational arithmetic, at most 39 walks.
template <int D>
bool stop_at_contact(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                     const Contact<D>& contact, Walk_counts& counts);

/// How walls answer.
struct Wall_response {
  double restitution = 0;  ///< share of the normal speed kept, [0,1]; 0: the particle slides
  double friction = 0;     ///< share of the tangential speed lost at each contact, [0,1]
  /// Contacts of one particle in one step; where there are more it rests until the next step.
  int most_contacts = 8;
};

/// Moves a particle by `velocity` for a unit of time. At each contact it stops (stop_at_contact), its
/// velocity is reflected or made to slide along the wall, and the rest of the time is a new move, lifted off
/// the wall by a few ulp. A particle that slides into a corner goes on along the edge between the two walls,
/// or rests. Returns the velocity at the end. The particle satisfies I1 before and after. Contacts are
/// appended to `met`, their times as shares of the unit of time: the first is exact, those after it follow
/// from positions that are rounded.
/// \param snapshot in which the particle lies
/// \param particle satisfies I1
/// \param velocity in units of the environment per unit of time
/// \param response restitution and friction in [0,1]
/// \param met receives the contacts
/// \param counts raised by the walks
/// \pre response is in range
/// \throw Error(usage) as move(); Error(input) if the point where it would be is not finite; nothing changes
template <int D>
Vector<D> advance(const Snapshot<D>& snapshot, Particle<D>& particle, Vector<D> velocity,
                  const Wall_response& response, std::vector<Contact<D>>& met, Walk_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_BODY_VERIFIED_STOP_H
