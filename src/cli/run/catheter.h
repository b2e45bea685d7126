// SPDX-License-Identifier: LGPL-3.0-or-later
// The catheter of a run: laid before it, reported after it.
#ifndef CELLWALK_CLI_RUN_CATHETER_H
#define CELLWALK_CLI_RUN_CATHETER_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/rod.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace cellwalk::cli {

/// Finds the path of a catheter that has only the ends of one. Groups are those of the file of the
/// environment, and those of the scene.
/// \throw Error as lay_along_centre_line(), naming the scene
template <int D>
void lay_catheter(Scene<D>& scene, const std::string& scene_name, const Snapshot<D>& snapshot,
                  const Groups<D>& groups);

/// Where the catheter is, and what holds it short of its end.
template <int D>
nlohmann::ordered_json catheter_json(const Rod<D>& rod);
/// For people.
template <int D>
std::string describe_catheter(const Rod<D>& rod);

extern template void lay_catheter(Scene<2>&, const std::string&, const Snapshot<2>&, const Groups<2>&);
extern template void lay_catheter(Scene<3>&, const std::string&, const Snapshot<3>&, const Groups<3>&);
extern template nlohmann::ordered_json catheter_json(const Rod<2>&);
extern template nlohmann::ordered_json catheter_json(const Rod<3>&);
extern template std::string describe_catheter(const Rod<2>&);
extern template std::string describe_catheter(const Rod<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_CATHETER_H
