// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of what the oracle says of walks.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TALLY_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TALLY_H

#include <cellwalk/walk/walk.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "walk/walk_judge.h"

namespace cellwalk::exact_float {

/// The verdicts of the judge, with `lost` split in two.
enum class Outcome {
  right,
  missed_wall,
  false_contact,
  wrong_cell,
  illegal_way,
  stuck,  ///< the signs show no way out of a cell
  lost,   ///< walked in circles until it was stopped
  wrong_time,
  wrong_kind,
  wrong_wall,  ///< or a wrong normal
  wrong_dimension
};
inline constexpr std::array<const char*, 11> outcome_names{
    "right", "missed_wall", "false_contact", "wrong_cell", "illegal_way",    "stuck",
    "lost",  "wrong_time",  "wrong_kind",    "wrong_wall", "wrong_dimension"};

using Tally = std::array<std::uint64_t, outcome_names.size()>;

inline std::uint64_t total(const Tally& tally) {
  return std::accumulate(tally.begin(), tally.end(), std::uint64_t{0});
}
inline std::uint64_t wrong(const Tally& tally) { return total(tally) - tally[0]; }

inline void add(Tally& sum, const Tally& tally) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += tally[i];
}

/// Judges a walk by the oracle alone. It may go on any sides of walls, as rounded kernels look for no others.
template <int D>
Outcome outcome_of(const oracle::Oracle<D>& oracle, const Snapshot<D>& snapshot,
                   const oracle::Case<D>& motion, const Walk_result<D>& result,
                   const std::vector<Cell>& visited) {
  using oracle::Verdict;
  switch (oracle::judge_walk(oracle, snapshot, motion, result, visited, oracle::Sides_due::any)) {
    case Verdict::right:
      return Outcome::right;
    case Verdict::lost:  // a walk that ends visits each cell once
      return result.cells > snapshot.cell_count() ? Outcome::lost : Outcome::stuck;
    case Verdict::missed_wall:
      return Outcome::missed_wall;
    case Verdict::false_contact:
      return Outcome::false_contact;
    case Verdict::wrong_cell:
      return Outcome::wrong_cell;
    case Verdict::illegal_way:
      return Outcome::illegal_way;
    case Verdict::wrong_time:
      return Outcome::wrong_time;
    case Verdict::wrong_kind:
      return Outcome::wrong_kind;
    case Verdict::wrong_wall:
    case Verdict::wrong_normal:
      return Outcome::wrong_wall;
    case Verdict::wrong_dimension:
      break;
  }
  return Outcome::wrong_dimension;
}

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TALLY_H
