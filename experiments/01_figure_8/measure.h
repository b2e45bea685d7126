// SPDX-License-Identifier: LGPL-3.0-or-later
// Measures all methods on one recorded trace: built, checked against the exact answers, timed round by round.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_MEASURE_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_MEASURE_H

#include <cstdint>
#include <string>
#include <vector>

#include "peers/families.h"

namespace cellwalk::figure_8 {

/// Answer bits that differ from the exact ones, among those that a method gives.
struct Wrong_answers {
  std::uint64_t missed = 0;    ///< exact: a hit
  std::uint64_t reported = 0;  ///< exact: none
};

/// One method on one trace.
struct Row {
  std::string method;
  bool is_reproducible = true;  ///< counts and wrong answers are the same on every machine
  Build build;
  std::uint64_t hits = 0;  ///< of the exact answers, among the bits that the method gives
  Wrong_answers wrong;
  Counts counts;
  std::vector<double> rounds;  ///< nanoseconds a move of a vertex
  double median() const;
};

struct Measure_options {
  int rounds = 7;  ///< after one to warm up; 0: no times are taken
  /// A method that would need longer for all its rounds gets fewer, at least one.
  double seconds = 30;
  std::string only;  ///< names of methods have to match this regular expression; empty: all
};

/// Builds the methods and replays the trace with each, one after the other within a round, so that what
/// disturbs the machine for a while disturbs them alike.
/// \throw std::runtime_error if a method answers a later round otherwise than the first
std::vector<Row> measure(const Grid_world& world, const Trace& trace, const std::vector<Family>& families,
                         const Measure_options& options);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_MEASURE_H
