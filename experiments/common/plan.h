// SPDX-License-Identifier: LGPL-3.0-or-later
// What a program of an experiment is called with.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PLAN_H
#define CELLWALK_EXPERIMENTS_COMMON_PLAN_H

#include <cstdint>
#include <string>

namespace cellwalk::experiments {

/// What a run is to do.
struct Plan {
  bool quick = false;
  int threads = 1;
  int rounds = 0;  ///< timed, by one thread
  std::uint64_t seed = 1;
  std::string commit = "unknown";
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PLAN_H
