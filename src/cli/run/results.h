// SPDX-License-Identifier: LGPL-3.0-or-later
// The results of `cellwalk run` in a folder, read again and checked.
#ifndef CELLWALK_CLI_RUN_RESULTS_H
#define CELLWALK_CLI_RUN_RESULTS_H

#include <cellwalk/internal/io/recording_file.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>

namespace cellwalk::cli {

struct Run_results {
  nlohmann::ordered_json report;  ///< run.json
  io::Recording motion;           ///< motion.gz
  /// contacts.csv as pages take it, little endian: their number (uint32), their steps (uint32), points and
  /// normals (3 float32 each), kinds (uint8, by Contact_kind).
  std::string contacts;
  std::size_t contact_count = 0;
};

/// \throw Error(input) `FILE: what, and what to do`: no folder, not that of a run, a file that is missing or
///        damaged, or files that do not belong together
Run_results read_run(const std::filesystem::path& folder);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_RESULTS_H
