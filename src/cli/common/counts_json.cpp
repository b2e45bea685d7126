// SPDX-License-Identifier: LGPL-3.0-or-later
// The counts of walks as JSON.
#include "counts_json.h"

#include <nlohmann/json.hpp>

namespace cellwalk::cli {

nlohmann::ordered_json to_json(const Walk_counts& counts) {
  nlohmann::ordered_json result = to_json<Walk_counts>(counts);
  result.update(to_json(counts.predicates));
  return result;
}

}  // namespace cellwalk::cli
