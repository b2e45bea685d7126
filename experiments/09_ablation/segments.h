// SPDX-License-Identifier: LGPL-3.0-or-later
// What three segments do not find along the recorded motion of a body, by the judge.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_SEGMENTS_H
#define CELLWALK_EXPERIMENTS_ABLATION_SEGMENTS_H

#include <cellwalk/edge/sweep.h>

#include <concepts>
#include <string>
#include <type_traits>

#include "scenes.h"

namespace cellwalk::ablation {

/// All edges of all vertices that were asked to move, and whose own way is free.
struct Asked_tally {
  std::uint64_t moves = 0, vertices_blocked = 0;
  std::uint64_t edges = 0;
  std::uint64_t swept = 0;   ///< a wall passes through the edge on its way, by the judge
  std::uint64_t at_end = 0;  ///< and is in its way at the end: what three segments see
  std::uint64_t unseen = 0;  ///< swept, and not at the end
  std::uint64_t rounds = 0;  ///< moves all of whose edges are free at the end, some not on the way
  std::uint64_t wrong = 0;   ///< recorded answers that the judge does not give
  std::uint64_t undecided = 0;
};

/// Vertices that stop just before the first contact which a sweep finds.
struct Stop_tally {
  std::uint64_t moves = 0;
  std::uint64_t contacts = 0, of_edges = 0;
  std::uint64_t through = 0;  ///< moves made on which a wall passes through an edge, or stands in the way
  std::uint64_t steps_through = 0;  ///< steps that have such a move
  std::uint64_t undecided = 0;
};

struct Segment_row {
  std::string scene;
  Asked_tally asked;
  Stop_tally three_segments, complete;
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& row) requires std::same_as<std::remove_const_t<Value>, Segment_row> {
  archive(row.scene);
  archive(row.asked);
  archive(row.three_segments);
  archive(row.complete);
}

/// Each step begins where the recorded motion has the bodies.
Segment_row run_segments(const std::string& name, const real_scenes::Loaded_scene& scene);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_SEGMENTS_H
