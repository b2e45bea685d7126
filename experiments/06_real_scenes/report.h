// SPDX-License-Identifier: LGPL-3.0-or-later
// The results as files: real_scenes.csv (a row a method, margin and scene), answers.csv (what of it is the
// same on every machine) and manifest.json.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H

#include <concepts>
#include <filesystem>
#include <string>
#include <type_traits>
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

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& value) requires std::same_as<std::remove_const_t<Value>, Result> {
  archive(value.scene);
  for (auto* count : {&value.cells, &value.walls, &value.bodies, &value.vertices, &value.edges, &value.steps,
                      &value.blocked})
    archive(*count);
  archive(value.step_length);
  archive(value.rows);
}

/// Writes the files into a folder, which must exist.
void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const Measure_options& options, const std::string& commit);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_REPORT_H
