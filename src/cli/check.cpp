// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk check ENV: certifies an environment, including its map, and reports its content.
#include <cellwalk/environment/compiled.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>

#include "cli/common/command.h"
#include "cli/common/edge_cells.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"

namespace cellwalk::cli {
namespace {

struct Check_options {
  std::string environment, json;
  double edge_length = 0;
  Build_options build;
};

void check(const Check_options& options) {
  Outputs outputs({options.environment});
  io::Atomic_file* const json = outputs.file(options.json);
  const Loaded_environment loaded = load_with_progress(options.environment, options.build);
  std::visit(
      [&]<int D>(const Environment<D>& environment) {
        Facing_walls facing;
        const Certificate certificate =
            naming(options.environment, [&] { return environment.certify(&facing); });
        // An environment that was compiled elsewhere may be wrong.
        if (loaded.is_compiled) naming(options.environment, [&] { check_compiled(environment); });
        const Edge_cells edges = count_edge_cells(environment.snapshot(), {.length = options.edge_length});
        write_json(json, {{"environment", options.environment},
                          {"certificate", to_json(certificate, D)},
                          {"facing_walls", to_json(facing)},
                          {"edge_cells", to_json(edges)}});
        std::string text = summary(options.environment, certificate, D, edges);
        for (const std::string& note : notes(facing)) text += fmt::format("  {:<12}{}\n", "noted", note);
        outputs.commit(text);
      },
      loaded.environment);
}

}  // namespace

void add_check(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Check_options>();
  CLI::App* command = app.add_subcommand(
      "check", "Certify an environment exactly, and print counts, volumes, walls and components");
  command
      ->add_option("environment", options->environment, "A file of cells (.ovm, .cellwalk, .msh, .vtk, ...)")
      ->required()
      ->type_name("ENV");
  add_duplicates(*command, options->build.duplicates);
  add_edge_length(*command, options->edge_length);
  add_json(*command, options->json);
  add_examples(*command, {"cellwalk check vessel.ovm", "cellwalk check vessel.ovm --edge-length 0.2",
                          "cellwalk check mesh.vtu --duplicates merge --json report.json"});
  command->callback([options, &chosen] { chosen = [options] { check(*options); }; });
}

}  // namespace cellwalk::cli
