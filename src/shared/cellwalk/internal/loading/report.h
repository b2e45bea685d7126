// SPDX-License-Identifier: LGPL-3.0-or-later
// Reports of building and certifying an environment, as text and as JSON.
#ifndef CELLWALK_INTERNAL_LOADING_REPORT_H
#define CELLWALK_INTERNAL_LOADING_REPORT_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/refine.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace cellwalk {

/// The counts of a certificate, one line each.
std::string describe(const Certificate& certificate, int dimension);
nlohmann::ordered_json to_json(const Certificate& certificate, int dimension);

/// The changes made by building, one sentence each, or one sentence if there were none.
std::vector<std::string> changes(const Build_report& built);
nlohmann::ordered_json to_json(const Build_report& built);

/// What became of cells that did not conform, one sentence each, if there were any.
std::vector<std::string> changes(const Refinement& refined);
nlohmann::ordered_json to_json(const Refinement& refined);

/// A sentence on each kind of walls between free cells that nothing parts, if there are any.
std::vector<std::string> notes(const Facing_walls& facing);
nlohmann::ordered_json to_json(const Facing_walls& facing);

/// The text of a rounded figure, such as a volume.
std::string rounded(double value);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_LOADING_REPORT_H
