// SPDX-License-Identifier: LGPL-3.0-or-later
// The results as files: figure_8.csv (a row a method and trace) and manifest.json (what they were measured
// with).
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_REPORT_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_REPORT_H

#include <filesystem>
#include <string>
#include <vector>

#include "measure.h"

namespace cellwalk::figure_8 {

/// One trace and what was measured on it. The trace itself is not kept.
struct Result {
  std::string trace;  ///< the name of its file
  std::uint64_t cells = 0, solid_cells = 0, walls = 0, seed = 0;
  double body_side = 0, speed = 0;
  std::uint32_t bodies = 0, steps = 0;
  std::uint64_t held = 0;  ///< moves after which the vertex is where it was: a wall is in the way
  std::vector<Row> rows;

  std::uint64_t moves() const { return std::uint64_t{bodies} * steps * trace_vertices; }
};

/// Writes both files into a folder, which must exist.
void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const std::vector<Family>& families, const Measure_options& options,
                  const std::string& commit);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_REPORT_H
