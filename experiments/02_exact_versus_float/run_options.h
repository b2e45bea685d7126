// SPDX-License-Identifier: LGPL-3.0-or-later
// What all parts of the experiment are told, and what they say of the exact kernels.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_RUN_OPTIONS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_RUN_OPTIONS_H

#include <bitset>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/kept_counts.h"
#include "kernels.h"

namespace cellwalk::exact_float {

struct Run_options {
  std::filesystem::path folder;  ///< must exist
  std::uint64_t seed = 1;
  std::uint64_t count = 0;                      ///< motions or sweeps at each point of the grid
  std::bitset<kernel_count> kernels{~0ull};     ///< those that walk; of failures and times all do
  experiments::Kept_counts* kept = nullptr;     ///< of points of the grid; must outlive the run
  std::vector<std::filesystem::path> meshes{};  ///< walked in, beside the worlds of the grid
};

/// What the exact kernels did.
struct Exact_summary {
  std::uint64_t motions = 0;   ///< judged by the oracle
  std::uint64_t by_exact = 0;  ///< walks or sweeps of all exact kernels
  std::uint64_t wrong = 0;
};

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_RUN_OPTIONS_H
