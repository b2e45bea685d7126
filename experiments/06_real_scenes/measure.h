// SPDX-License-Identifier: LGPL-3.0-or-later
// Measures all methods on one scene: built, judged by the exact answers, timed round by round and step by
// step.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_MEASURE_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_MEASURE_H

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "peers/peer.h"

namespace cellwalk::real_scenes {

/// One method on one scene.
struct Row {
  std::string method, library;
  bool is_exact = false, is_reproducible = true;
  double margin = 0;
  Build build;
  double edge_cells = 0;                   ///< as of the method
  std::uint64_t missed = 0, reported = 0;  ///< moves answered free, or blocked, that are not
  std::optional<Body_counts> counts;
  std::vector<double> rounds;   ///< nanoseconds a move of a vertex
  std::vector<double> step_us;  ///< microseconds of each step, the least of all rounds
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& row) requires std::same_as<std::remove_const_t<Value>, Row> {
  archive(row.method);
  archive(row.library);
  archive(row.is_exact);
  archive(row.is_reproducible);
  archive(row.margin);
  experiments::members_of_build(archive, row.build);
  archive(row.edge_cells);
  archive(row.missed);
  archive(row.reported);
  archive(row.counts);
  archive(row.rounds);
  archive(row.step_us);
}

struct Measure_options {
  int rounds = 7;  ///< after one to warm up; 0: no times are taken
  /// A method that would need longer for all its rounds gets fewer, at least one.
  double seconds = 20;
  std::string only;  ///< names of methods have to match this regular expression; empty: all
};

/// Builds the methods and replays the motion with each, one after the other within a round, so that what
/// disturbs the machine for a while disturbs them alike.
/// \throw std::runtime_error if a method answers a later round otherwise than the first
std::vector<Row> measure(const Scene_walls& walls, const Motion& motion, const Measure_options& options);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_MEASURE_H
