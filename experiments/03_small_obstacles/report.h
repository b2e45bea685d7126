// SPDX-License-Identifier: LGPL-3.0-or-later
// What is run, and the tables it is written to.
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_REPORT_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_REPORT_H

#include <filesystem>

#include "common/plan.h"

namespace cellwalk::small_obstacles {

using experiments::Plan;

/// Runs all rows and writes the tables into a folder, which must exist. The same bytes for any number of
/// threads, but for timings.csv.
/// \throw Error(other) where a file cannot be written
void run(const Plan& plan, const std::filesystem::path& folder);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_REPORT_H
