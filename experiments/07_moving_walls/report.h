// SPDX-License-Identifier: LGPL-3.0-or-later
// The results as files: moving_walls.csv (a row a method, arithmetic and scene), answers.csv (what of it is
// the same on every machine) and manifest.json.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_REPORT_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_REPORT_H

#include <filesystem>
#include <string>
#include <vector>

#include "measure.h"

namespace cellwalk::moving_walls {

/// Writes the files into a folder, which must exist.
void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const Measure_options& options, const std::string& commit);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_REPORT_H
