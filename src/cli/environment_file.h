// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments from and to files, for every command that takes one.
#ifndef CELLWALK_CLI_ENVIRONMENT_FILE_H
#define CELLWALK_CLI_ENVIRONMENT_FILE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <variant>

#include "cli/command.h"

namespace cellwalk::cli {

using Any_environment = std::variant<Environment<2>, Environment<3>>;

struct Loaded_environment {
  Any_environment environment;
  Build_report built;
  io::Read_report read;
};

/// Runs `work`; an Error that leaves it without naming the file gets `path: ` in front.
template <class Work>
auto naming(const std::string& path, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error& error) {
    const std::string message = error.what();
    throw Error(error.code(), message.starts_with(path) ? message : path + ": " + message);
  }
}

/// Reads a file of cells and certifies it as it stands: nothing is split, merged or flipped.
/// \throw Error(input) if it is unreadable or holds no cells, Error(not_certified) with the cell and the reason
Loaded_environment load_environment(const std::string& path, Build_options options);

/// Adds --duplicates, which says what equal vertices mean.
void add_duplicates(CLI::App& command, Duplicate_vertices& value);

/// Adds the output option -o for an environment, which must be named *.ovm (or be a device).
void add_environment_output(CLI::App& command, std::string& path);

/// Adds --json OUT.
void add_json(CLI::App& command, std::string& path);
/// Writes a report where --json asked for one.
void write_json(const std::string& path, const nlohmann::ordered_json& report);

/// What certification found, as text for people and as JSON.
std::string describe(const Certificate& certificate, int dimension);
nlohmann::ordered_json to_json(const Certificate& certificate, int dimension);

/// Volumes and other rounded figures, for people.
std::string rounded(double value);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_ENVIRONMENT_FILE_H
