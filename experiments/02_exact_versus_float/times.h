// SPDX-License-Identifier: LGPL-3.0-or-later
// What kernels cost: times.csv. Not compared by the test: times differ from machine to machine.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TIMES_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TIMES_H

#include "run_options.h"

namespace cellwalk::exact_float {

/// Walks `count` motions by each kernel, degenerate ones and those displaced by 2^40 ulp, free ones and
/// blocked ones, on one thread: nanoseconds of processor time and bytes allocated (and freed again) a walk,
/// medians of five rounds.
void run_times(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_TIMES_H
