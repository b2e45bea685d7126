// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles as bytes, see byte_archive.h.
#ifndef CELLWALK_INTERNAL_WALK_SAVED_PARTICLE_H
#define CELLWALK_INTERNAL_WALK_SAVED_PARTICLE_H

#include <cellwalk/walk/locate.h>

namespace cellwalk::detail {

template <class Archive, int D>
void visit_parts(Archive& a, Particle<D>& particle) {
  a(particle.position, particle.cell, particle.dimension, particle.aimed);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_SAVED_PARTICLE_H
