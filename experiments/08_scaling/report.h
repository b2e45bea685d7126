// SPDX-License-Identifier: LGPL-3.0-or-later
// The tables of the experiment.
#ifndef CELLWALK_EXPERIMENTS_SCALING_REPORT_H
#define CELLWALK_EXPERIMENTS_SCALING_REPORT_H

#include <filesystem>

#include "common/plan.h"

namespace cellwalk::scaling {

/// Runs all scenes and writes handovers.csv, parts.csv, manifest.json and, if it is to be timed, timings.csv.
void run(const experiments::Plan& plan, const std::filesystem::path& folder);

}  // namespace cellwalk::scaling

#endif  // CELLWALK_EXPERIMENTS_SCALING_REPORT_H
