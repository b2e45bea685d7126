// SPDX-License-Identifier: LGPL-3.0-or-later
// What is run, and the tables it is written to.
#ifndef CELLWALK_EXPERIMENTS_CONTACT_SEARCH_REPORT_H
#define CELLWALK_EXPERIMENTS_CONTACT_SEARCH_REPORT_H

#include <cstdint>
#include <filesystem>
#include <string>

namespace cellwalk::contact_search {

struct Plan {
  bool quick = false;
  int threads = 1;  ///< worlds at the same time; 1 if it is timed
  int rounds = 0;   ///< timed
  std::uint64_t seed = 1;
  std::string commit = "unknown";
};

/// Runs all searches in all worlds and writes the tables into a folder, which must exist. The same bytes for
/// any number of threads, but for timings.csv.
/// \throw Error(other) where a file cannot be written
void run(const Plan& plan, const std::filesystem::path& folder);

}  // namespace cellwalk::contact_search

#endif  // CELLWALK_EXPERIMENTS_CONTACT_SEARCH_REPORT_H
