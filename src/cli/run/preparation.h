// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment of a scene, as its run needs it.
#ifndef CELLWALK_CLI_RUN_PREPARATION_H
#define CELLWALK_CLI_RUN_PREPARATION_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/loading/environment_file.h>

#include <string>
#include <vector>

namespace cellwalk::cli {

struct Prepared_environment {
  Any_environment environment;
  Certificate certificate;
  Any_groups groups{};               ///< that its file names
  std::vector<std::string> lines{};  ///< on an import
};

/// True if walls or changes of the scene replace cells, or open and close facets.
template <int D>
bool needs_map(const Scene<D>& scene);

/// True if anything of it may be different after a step.
template <int D>
bool changes_environment(const Scene<D>& scene) {
  return scene.walls || !scene.changes.list.empty();
}

/// Reads, generates or imports it.
/// \param scene_name for errors
/// \param ranks that need it, too: it is made once on each node
/// \throw Error as load_environment() and import_or_reopen(); Error(input) for a recipe that is none
template <int D>
Prepared_environment prepare(const Scene<D>& scene, const std::string& scene_name, Ranks& ranks);

extern template bool needs_map(const Scene<2>&);
extern template bool needs_map(const Scene<3>&);
extern template Prepared_environment prepare(const Scene<2>&, const std::string&, Ranks&);
extern template Prepared_environment prepare(const Scene<3>&, const std::string&, Ranks&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_PREPARATION_H
