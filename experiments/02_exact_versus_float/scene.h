// SPDX-License-Identifier: LGPL-3.0-or-later
// A world with what is needed to walk in it and to judge walks.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SCENE_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SCENE_H

#include <cellwalk/internal/environment/gluing.h>

#include <optional>
#include <utility>

#include "oracle/oracle.h"
#include "walk/walk_judge.h"
#include "worlds.h"

namespace cellwalk::exact_float {

template <int D>
struct Scene {
  explicit Scene(World<D> w)
      : world(std::move(w)),
        oracle(world.soup),
        snapshot(Snapshot<D>::compile(world.soup, glue(world.soup))) {}

  /// A particle in one of the free cells that hold a point, by the oracle; nothing if there is none.
  std::optional<Particle<D>> particle_at(const Point<D>& p, Random& random) const {
    const oracle::Place place = oracle.place(p);
    if (place.free_cells.empty()) return {};
    const std::uint32_t cell = place.free_cells[random.below(place.free_cells.size())];
    return Particle<D>{p, snapshot.cell(cell), static_cast<std::uint16_t>(place.dimension), 0};
  }

  /// A motion of a particle, and the truth about it.
  oracle::Case<D> motion_of(const Particle<D>& from, const Point<D>& to) const {
    oracle::Case<D> motion;
    motion.from = from.position;
    motion.to = to;
    motion.start = snapshot.index(from.cell);
    motion.trace = oracle.trace(motion.from, motion.to);
    motion.truth = oracle::judge(motion.trace, motion.start);
    return motion;
  }

  const World<D> world;
  const oracle::Oracle<D> oracle;
  const Snapshot<D> snapshot;
};

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SCENE_H
