// SPDX-License-Identifier: LGPL-3.0-or-later
// The output of commands that certify an environment: its certificate, and the cells of edges.
#ifndef CELLWALK_CLI_COMMON_EDGE_CELLS_H
#define CELLWALK_CLI_COMMON_EDGE_CELLS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/query/query.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "command.h"

namespace cellwalk::cli {

/// Adds --edge-length.
void add_edge_length(CLI::App& command, double& length);

/// The lines about a certified environment.
std::string summary(const std::string& path, const Certificate& certificate, int dimension,
                    const Edge_cells& edges);

nlohmann::ordered_json to_json(const Edge_cells& edges);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_EDGE_CELLS_H
