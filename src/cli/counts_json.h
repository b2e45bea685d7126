// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of work in reports.
#ifndef CELLWALK_CLI_COUNTS_JSON_H
#define CELLWALK_CLI_COUNTS_JSON_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/walk/walk.h>

#include <nlohmann/json_fwd.hpp>

namespace cellwalk::cli {

nlohmann::ordered_json to_json(const Walk_counts& counts);
/// Without those of walks.
nlohmann::ordered_json to_json(const Edge_counts& counts);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COUNTS_JSON_H
