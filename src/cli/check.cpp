// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk check ENV: certifies an environment, including its map, and reports its content.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

#include "cli/common/command.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"

namespace cellwalk::cli {
namespace {

struct Check_options {
  std::string environment, json;
  Build_options build;
};

void check(const Check_options& options) {
  Outputs outputs({options.environment});
  io::Atomic_file* const json = outputs.file(options.json);
  const Loaded_environment loaded = load_with_progress(options.environment, options.build);
  std::visit(
      [&]<int D>(const Environment<D>& environment) {
        const Certificate certificate = naming(options.environment, [&] { return environment.certify(); });
        write_json(json, {{"environment", options.environment}, {"certificate", to_json(certificate, D)}});
        outputs.commit(
            fmt::format("{}: certified, {}D\n{}", options.environment, D, describe(certificate, D)));
      },
      loaded.environment);
}

}  // namespace

void add_check(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Check_options>();
  CLI::App* command = app.add_subcommand(
      "check", "Certify an environment exactly, and print counts, volumes, walls and components");
  command->add_option("environment", options->environment, "A file of cells (.ovm, .msh, .vtk, ...)")
      ->required()
      ->type_name("ENV");
  add_duplicates(*command, options->build.duplicates);
  add_json(*command, options->json);
  add_examples(*command, {"cellwalk check vessel.ovm",
                          "cellwalk check mesh.vtu --duplicates merge --json report.json"});
  command->callback([options, &chosen] { chosen = [options] { check(*options); }; });
}

}  // namespace cellwalk::cli
