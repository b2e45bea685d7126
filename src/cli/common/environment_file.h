// SPDX-License-Identifier: LGPL-3.0-or-later
// Reading and writing of environment files by commands.
#ifndef CELLWALK_CLI_COMMON_ENVIRONMENT_FILE_H
#define CELLWALK_CLI_COMMON_ENVIRONMENT_FILE_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/loading/report.h>
#include <cellwalk/loading/environment_file.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "command.h"

namespace cellwalk::cli {

// Beside the reports of commands.
using cellwalk::to_json;

/// load_environment() with a line of progress.
Loaded_environment load_with_progress(const std::string& path, const Build_options& options);

/// Adds --duplicates, the treatment of equal vertices, and of facets that overlap.
void add_duplicates(CLI::App& command, Duplicate_vertices& value);

/// Adds the output option -o for an environment, whose name must be *.ovm, *.cellwalk, or that of a device.
CLI::Option* add_environment_output(CLI::App& command, std::string& path);

/// Adds --json OUT.
void add_json(CLI::App& command, std::string& path);
/// Writes a report to the file of --json; none if it is null.
void write_json(io::Atomic_file* file, const nlohmann::ordered_json& report);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_ENVIRONMENT_FILE_H
