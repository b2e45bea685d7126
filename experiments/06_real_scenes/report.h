// SPDX-License-Identifier: LGPL-3.0-or-later
// The results as files: real_scenes.csv (a row a method, margin and scene), answers.csv (what of it is the
// same on every machine) and manifest.json.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H

#include <filesystem>
#include <string>
#include <vector>

#include "measure.h"

namespace cellwalk::real_scenes {

/// One scene and what was measured in it. The motion itself is not kept.
struct Result {
  std::string scene;
  std::uint64_t cells = 0, walls = 0, bodies = 0, vertices = 0, edges = 0, steps = 0, blocked = 0;
  double step_length = 0;
  std::vector<Row> rows;

  std::uint64_t moves() const { return vertices * steps; }
};

/// Writes the files into a folder, which must exist.
void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const Measure_options& options, const std::string& commit);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H
