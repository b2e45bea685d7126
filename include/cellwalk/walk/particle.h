// SPDX-License-Identifier: LGPL-3.0-or-later
// A particle: a point that remembers its cell and the facet it aims at. Paper: section II (PCD).
#ifndef CELLWALK_WALK_PARTICLE_H
#define CELLWALK_WALK_PARTICLE_H

#include <cellwalk/environment/snapshot.h>

#include <cstdint>

namespace cellwalk {

/// Position, cell, dimension of the lowest cell that contains it, and the facet it aims at (a half-facet
/// identifies the aimed-at dart; with the position it spans the predictive simplex). Invariant I1: the
/// position lies in the closure of the cell.
template <int D>
struct Particle {
  Point<D> position;
  Cell cell = Cell::none;
  std::uint16_t dimension = D;  ///< D: interior of the cell .. 0: on a vertex
  std::uint16_t aimed = 0;      ///< the facet of the cell at which it aims
};

/// True if a point lies in the closure of a cell, by exact predicates: invariant I1 of a particle. False if
/// the cell does not exist (any more), or a coordinate is not finite.
template <int D>
bool in_closure(const Snapshot<D>& snapshot, Cell cell, const Point<D>& point);

}  // namespace cellwalk

#endif  // CELLWALK_WALK_PARTICLE_H
