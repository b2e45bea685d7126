// SPDX-License-Identifier: LGPL-3.0-or-later
// Loading with a progress line, and the options that all commands on environments share.
#include "environment_file.h"

#include <cellwalk/internal/io/json_file.h>

#include <nlohmann/json.hpp>

#include <filesystem>

#include "progress.h"

namespace cellwalk::cli {

Loaded_environment load_with_progress(const std::string& path, const Build_options& options) {
  const Progress progress("reading and certifying " + path);
  return load_environment(path, options);
}

void add_duplicates(CLI::App& command, Duplicate_vertices& value) {
  add_choice(
      command, "--duplicates", value,
      {{"refuse", Duplicate_vertices::refuse},
       {"merge", Duplicate_vertices::merge},
       {"keep", Duplicate_vertices::keep}},
      "Vertices in the same place: refuse the file, merge them, or keep them apart (a slit); facets that "
      "overlap without being shared are refused unless they are kept, as walls");
}

CLI::Option* add_environment_output(CLI::App& command, std::string& path) {
  return command
      .add_option("-o,--output", path,
                  "The environment to write: OpenVolumeMesh ASCII (*.ovm), or compiled (*.cellwalk), which "
                  "opens at once")
      ->required()
      ->type_name("ENV.ovm")
      ->check([](const std::string& text) {
        const bool fine = std::filesystem::path(text).extension() == ".ovm" || is_compiled_name(text) ||
                          text.starts_with("/dev/");
        return fine ? std::string{}
                    : "environments are written as OpenVolumeMesh or compiled: name the file *.ovm or "
                      "*.cellwalk, "
                      "not " +
                          text;
      });
}

void add_json(CLI::App& command, std::string& path) {
  command.add_option("--json", path, "Write the report as JSON too")->type_name("FILE");
}

void write_json(io::Atomic_file* file, const nlohmann::ordered_json& report) {
  if (file != nullptr) io::write_json(*file, report);
}

}  // namespace cellwalk::cli
