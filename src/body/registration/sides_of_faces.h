// SPDX-License-Identifier: LGPL-3.0-or-later
// Registrations of bodies whose faces need other sides of walls than their edges alone. 3D. Theory:
// docs/bodies.md, registration.
#ifndef CELLWALK_BODY_REGISTRATION_SIDES_OF_FACES_H
#define CELLWALK_BODY_REGISTRATION_SIDES_OF_FACES_H

#include <cstddef>
#include <vector>

#include "body/body_state.h"

namespace cellwalk::detail {

enum class Side_search {
  found,
  none,  ///< no choice of sides lets all faces pass
  ended  ///< after most_steps_back, or where an edge has more chains than are listed: there may be one
};

/// The choices that are taken back before a search ends, and as many more for each vertex and edge that has
/// one.
constexpr std::size_t most_steps_back = 5'000, most_steps_back_of_choice = 20;

/// Searches sides of walls for the vertices of a body and chains for its edges on which no wall pierces a
/// face, and registers the body there, with its faces. Preferred are those that its edges alone would take.
/// \param body registered, with faces that a wall pierces; left as it is unless they are found
/// \param sides of each vertex: those between which its edges leave the choice
Side_search find_sides_of_faces(Body_state<3>& body, const std::vector<std::vector<Particle<3>>>& sides);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGISTRATION_SIDES_OF_FACES_H
