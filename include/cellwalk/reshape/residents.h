// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies and particles in an environment while it changes, and the outcome of a change.
#ifndef CELLWALK_RESHAPE_RESIDENTS_H
#define CELLWALK_RESHAPE_RESIDENTS_H

#include <cellwalk/body/body.h>
#include <cellwalk/walk/particle.h>

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk {

/// The bodies and particles in an environment. They must outlive the object that they are given to, and stay
/// where they are in memory.
template <int D>
struct Residents {
  std::vector<Body<D>*> bodies;
  std::vector<std::span<Particle<D>>> particles;
};

/// A vertex, edge or face of a body, or a particle.
struct Resident {
  bool is_particle = false;
  std::uint32_t owner = 0;  ///< position of the body in Residents::bodies, or of the span in its particles
  Body_feature feature = Body_feature::vertex;  ///< the kind of part; a particle is a vertex
  std::uint32_t number = 0;                     ///< of the vertex, edge, face or particle

  auto operator<=>(const Resident&) const = default;
};

/// The outcome of a change of an environment among them.
struct Outcome {
  bool is_made = false;           ///< also if nothing had to be changed
  std::string reason;             ///< why not, empty if made: one sentence without a full stop
  std::vector<Resident> held_by;  ///< every vertex, edge and face that forbids it, sorted
};

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_RESIDENTS_H
