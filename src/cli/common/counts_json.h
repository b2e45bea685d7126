// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of work in reports.
#ifndef CELLWALK_CLI_COMMON_COUNTS_JSON_H
#define CELLWALK_CLI_COMMON_COUNTS_JSON_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/kernel/counts.h>
#include <cellwalk/walk/walk.h>

#include <nlohmann/json.hpp>

#include <string>

namespace cellwalk::cli {

/// The counts of a set by name, without those of its inner sets.
template <Count_set Set>
nlohmann::ordered_json to_json(const Set& counts) {
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  for (const auto& [name, count] : named_counts(counts)) result[std::string(name)] = count;
  return result;
}

/// The counts of walks, with those of their signs.
nlohmann::ordered_json to_json(const Walk_counts& counts);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_COUNTS_JSON_H
