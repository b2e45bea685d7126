// SPDX-License-Identifier: LGPL-3.0-or-later
// What a result was made with: the head of each manifest.json. Nothing in it depends on the date.
#ifndef CELLWALK_EXPERIMENTS_COMMON_MANIFEST_H
#define CELLWALK_EXPERIMENTS_COMMON_MANIFEST_H

#include <nlohmann/json.hpp>

#include <string>

namespace cellwalk::experiments {

/// commit, cellwalk (its version), compiler, flags, processor, versions (cgal, boost). Experiments add what
/// is theirs: seed, threads, counts. The processor is "unknown" where the system does not tell.
nlohmann::ordered_json manifest(const std::string& commit);

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_MANIFEST_H
