// SPDX-License-Identifier: LGPL-3.0-or-later
// What building and certifying an environment found, as text for people and as JSON.
#ifndef CELLWALK_LOADING_REPORT_H
#define CELLWALK_LOADING_REPORT_H

#include <cellwalk/environment/environment.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace cellwalk {

/// What certification found: a line each.
std::string describe(const Certificate& certificate, int dimension);
nlohmann::ordered_json to_json(const Certificate& certificate, int dimension);

/// What building changed: a sentence each, or one that says that nothing was.
std::vector<std::string> changes(const Build_report& built);
nlohmann::ordered_json to_json(const Build_report& built);

/// Volumes and other rounded figures, for people.
std::string rounded(double value);

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_REPORT_H
