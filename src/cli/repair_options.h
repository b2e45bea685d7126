// SPDX-License-Identifier: LGPL-3.0-or-later
// The options of `cellwalk import` for surfaces that are open, not manifold, cross themselves, or are thick
// walls.
#ifndef CELLWALK_CLI_REPAIR_OPTIONS_H
#define CELLWALK_CLI_REPAIR_OPTIONS_H

#include <cellwalk/loading/environment_file.h>

#include <CLI/CLI.hpp>

#include <string>

namespace cellwalk::cli {

/// Adds them, in a build that can mesh.
/// \param options outlive the command
/// \param names the file with names for caps and mouths; outlives the command
void add_repair_options(CLI::App& command, Mesher_options& options, std::string& names);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_REPAIR_OPTIONS_H
