// SPDX-License-Identifier: LGPL-3.0-or-later
// The tables of the experiment.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_REPORT_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_REPORT_H

#include <filesystem>

#include "common/plan.h"

namespace cellwalk::track_lengths {

/// Writes checks.csv, threads.csv, failures.csv, manifest.json and, if it is to be timed, times.csv.
/// \param mesh a file of tetrahedra; empty: none
/// \throw std::runtime_error if a row is wrong or broken, or depends on the number of threads
void run(const experiments::Plan& plan, const std::filesystem::path& mesh,
         const std::filesystem::path& folder);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_REPORT_H
