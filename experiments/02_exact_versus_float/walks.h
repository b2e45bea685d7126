// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of every kernel over the grid, and in meshes, judged by the oracle: walks.csv.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H

#include "run_options.h"

namespace cellwalk::exact_float {

/// Runs in parallel; the tables do not depend on the number of threads.
/// Cost: about 0.1 ms a motion, most of it for the rational kernel and the oracle.
Exact_summary run_walks(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WALKS_H
