// SPDX-License-Identifier: LGPL-3.0-or-later
// Sweeps of edges, judged by the oracle of chains: sweeps.csv.
//
// Rounded kernels can walk, so they can do the paper's sweep of three segments: the way of p, then a
// temporary particle from where that leads to q. The complete sweep of the library exists with exact signs
// only. All are asked the same question: may the edge pq follow p?
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SWEEPS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SWEEPS_H

#include "run_options.h"

namespace cellwalk::exact_float {

/// Counted for the exact kernels: the complete sweep, which must never be wrong. Runs in parallel; the table
/// does not depend on the number of threads.
/// Cost: about 1 ms a sweep, most of it for the oracle.
Exact_summary run_sweeps(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_SWEEPS_H
