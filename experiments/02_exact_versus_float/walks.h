// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of every kernel over the grid, judged by the oracle: walks.csv, and a record of the first failure of each sort.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H

#include <cstdint>
#include <filesystem>

namespace cellwalk::exact_float {

struct Run_options {
  std::filesystem::path folder;  ///< must exist
  std::uint64_t seed = 1;
  std::uint64_t motions = 0;  ///< at each point of the grid
};

/// What the exact kernels did.
struct Exact_summary {
  std::uint64_t motions = 0;  ///< judged by the oracle
  std::uint64_t walks = 0;    ///< or sweeps, of all exact kernels
  std::uint64_t wrong = 0;
};

/// Runs in parallel; the tables do not depend on the number of threads.
/// Cost: about 0.2 ms a motion, most of it for the rational kernel and the oracle.
Exact_summary run_walks(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H
