// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment of a run, from a file or a generator.
#ifndef CELLWALK_CLI_RUN_PREPARED_ENVIRONMENT_H
#define CELLWALK_CLI_RUN_PREPARED_ENVIRONMENT_H

#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/records/scene.h>

#include <string>

namespace cellwalk::cli {

struct Prepared_environment {
  Any_environment environment;
  Certificate certificate;
  Any_groups groups{};  ///< that its file names
};

/// \param walls how they move; null: they stand still
/// \param scene names the scene in errors
/// \param ranks that need it, too: it is made once on each node
/// \throw Error(input) for what a recipe does not allow; else as load_environment()
template <int D>
Prepared_environment prepare(const Environment_source& source, const Scene_walls<D>* walls,
                             const Environment_changes<D>& changes, const std::string& scene, Ranks& ranks);

extern template Prepared_environment prepare(const Environment_source&, const Scene_walls<2>*,
                                             const Environment_changes<2>&, const std::string&, Ranks&);
extern template Prepared_environment prepare(const Environment_source&, const Scene_walls<3>*,
                                             const Environment_changes<3>&, const std::string&, Ranks&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_PREPARED_ENVIRONMENT_H
