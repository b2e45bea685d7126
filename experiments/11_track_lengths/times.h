// SPDX-License-Identifier: LGPL-3.0-or-later
// The library and its peers on the same rays, in rounds that take turns: times, and what peers get wrong.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TIMES_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TIMES_H

#include <string>
#include <vector>

#include "failures.h"

namespace cellwalk::track_lengths {

/// A method on a set of rays.
struct Method_result {
  std::string method;
  bool is_peer = true;
  Failures failures;            ///< of peers
  std::vector<double> seconds;  ///< of all rays, a round each
};

struct Comparison {
  std::uint64_t crossings = 0;  ///< facets crossed, by the library
  std::vector<Method_result> methods;
};

/// \param rounds of each method, timed after one that is not
/// \param warms_up each timed run follows another one of the same method, which leaves its data in the cache
Comparison compare(const World& world, const Rays& rays, int rounds, bool warms_up);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TIMES_H
