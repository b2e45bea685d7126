// SPDX-License-Identifier: LGPL-3.0-or-later
// What is checked of all rows, and of the first ones by the judge.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_CHECKS_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_CHECKS_H

#include <cellwalk/walk/trace.h>

#include <cstddef>
#include <cstdint>

#include "judge.h"
#include "rays.h"

namespace cellwalk::track_lengths {

/// Sums over rays. `broken` rows: a facet crossed does not lead on from the cell before, is a wall, or the
/// last one leads elsewhere than to the end; the cells of the pieces are not among those passed, in order; a
/// length is negative; or the sum of all is more than an ulp off the length of a motion that arrives, or that
/// much above it if a wall blocks it.
struct Check_counts {
  std::uint64_t rays = 0, pieces = 0, crossings = 0;
  std::uint64_t blocked = 0;  ///< by walls
  std::uint64_t empty = 0;    ///< pieces whose length rounds to 0
  std::uint64_t broken = 0;
  std::uint64_t judged = 0, judged_pieces = 0;
  std::uint64_t wrong = 0;          ///< of these rays, by the judge
  std::uint64_t without_signs = 0;  ///< of these, those that planes decide: no exact sign is computed
  std::uint64_t divided = 0;        ///< of these, those whose row is another one if the ray is traced alone
  std::uint64_t signs = 0, fallbacks = 0;  ///< of all rays
  std::uint64_t digest = 0;                ///< of all cells and lengths

  Check_counts& operator+=(const Check_counts& other);
};

struct Part {
  Ray_kind kind = Ray_kind::chords;
  std::size_t rays = 0, judged = 0;
  std::uint64_t seed = 0;
};

/// Draws rays, traces and checks them.
Check_counts check(const World& world, const Tracer<3>& tracer, const Judge& judge, const Part& part);

/// The digest alone.
std::uint64_t digest(const World& world, const Tracer<3>& tracer, const Part& part);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_CHECKS_H
