// SPDX-License-Identifier: LGPL-3.0-or-later
// The options of `cellwalk import` for surfaces that are open, not manifold, cross themselves, or are thick
// walls.
#ifndef CELLWALK_CLI_REPAIR_OPTIONS_H
#define CELLWALK_CLI_REPAIR_OPTIONS_H

#include <cellwalk/loading/environment_file.h>

#include <CLI/CLI.hpp>

namespace cellwalk::cli {

/// Adds them, in a build that can mesh.
/// \param import outlives the command
void add_repair_options(CLI::App& command, Import_options& import);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPAIR_OPTIONS_H
