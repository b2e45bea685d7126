// SPDX-License-Identifier: LGPL-3.0-or-later
// One copy of an environment for all ranks of a node.
#ifndef CELLWALK_CLI_COMMON_NODE_ENVIRONMENT_H
#define CELLWALK_CLI_COMMON_NODE_ENVIRONMENT_H

#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/loading/environment_file.h>

#include <functional>
#include <string>

namespace cellwalk::cli {

/// An environment that the first rank of each node makes, without a map. Its compiled bytes lie in memory
/// that the other ranks of the node map, so that nothing is certified, and nothing held, twice. Where that
/// memory cannot be had, each rank makes its own.
/// \throw Error as `make`
Loaded_environment once_a_node(Ranks& ranks, const std::function<Loaded_environment()>& make);

/// The environment of a file. Compiled ones are mapped by each rank, which shares their pages as well.
/// \throw Error as load_environment()
Loaded_environment load_once_a_node(Ranks& ranks, const std::string& path, const Build_options& options);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_NODE_ENVIRONMENT_H
