// SPDX-License-Identifier: LGPL-3.0-or-later
// Long simulations: the same particles bounce about the same world under each kernel. flights.csv, and the
// first escape of each rounded kernel as a record and, in 2D, as a path for a picture.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FLIGHTS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FLIGHTS_H

#include "run_options.h"

namespace cellwalk::exact_float {

/// `count` moves of each kernel. A particle that meets a wall goes to the rounded point of contact, if a walk
/// leads there, and is reflected; so most walks start within an ulp of a wall. One that escapes is put back.
/// The tables do not depend on the number of threads.
/// Cost: about 0.1 ms a move, for the oracle.
Exact_summary run_flights(const Run_options& options);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_FLIGHTS_H
