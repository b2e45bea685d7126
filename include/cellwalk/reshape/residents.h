// SPDX-License-Identifier: LGPL-3.0-or-later
// What lies in an environment while it changes.
#ifndef CELLWALK_RESHAPE_RESIDENTS_H
#define CELLWALK_RESHAPE_RESIDENTS_H

#include <cellwalk/body/body.h>
#include <cellwalk/walk/particle.h>

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// The bodies and particles in an environment. They must outlive what they are given to, and stay where they
/// are in memory.
template <int D>
struct Residents {
  std::vector<Body<D>*> bodies;
  std::vector<std::span<Particle<D>>> particles;
};

/// A vertex, edge or face of a body, or a particle.
struct Resident {
  bool is_particle = false;
  std::uint32_t owner = 0;  ///< position of the body in Residents::bodies, or of the span in its particles
  Body_feature feature = Body_feature::vertex;  ///< what of the body; a particle is a vertex
  std::uint32_t number = 0;                     ///< of the vertex, edge, face or particle

  auto operator<=>(const Resident&) const = default;
};

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_RESIDENTS_H
