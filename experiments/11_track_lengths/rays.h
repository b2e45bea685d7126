// SPDX-License-Identifier: LGPL-3.0-or-later
// Rays through a world: random chords, and rays in degenerate position.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_RAYS_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_RAYS_H

#include <cellwalk/internal/kernel/random.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "worlds.h"

namespace cellwalk::track_lengths {

enum class Ray_kind {
  chords,     ///< random, in general position
  degenerate  ///< through vertices, along edges, in planes of facets, with ends on facets, edges and vertices
};
inline constexpr Ray_kind ray_kinds[] = {Ray_kind::chords, Ray_kind::degenerate};
std::string_view name_of(Ray_kind kind);

/// Starts, located, and ends.
struct Rays {
  std::vector<Particle<3>> starts;
  std::vector<Point<3>> targets;

  std::size_t size() const { return targets.size(); }
};

/// Draws rays. Each starts in free space, and nearly all end there; what a degenerate one is said to meet, it
/// meets exactly: rays whose coordinates would have to be rounded are drawn again.
Rays draw(const World& world, Ray_kind kind, std::size_t count, std::uint64_t seed);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_RAYS_H
