// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk edit ENV CHANGES.json -o OUT.ovm: opens and closes facets, excavates, fills and cuts cells, and
// sews cuts up, as far as the bodies in the environment allow.
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/internal/io/changes_file.h>
#include <cellwalk/internal/loading/environment_writer.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/changes_table.h"
#include "cli/common/command.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"
#include "cli/common/standing_bodies.h"

namespace cellwalk::cli {
namespace {

struct Edit_options {
  std::string environment, changes, output, report, json;
  std::vector<std::string> bodies;
  Build_options build{};
};

/// The output files; null for those not requested.
struct Edit_files {
  explicit Edit_files(const Edit_options& options)
      : all(inputs(options)),
        environment(all.file(options.output)),
        report(all.file(options.report)),
        json(all.file(options.json)) {}

  Outputs all;
  io::Atomic_file *environment, *report, *json;

 private:
  static std::vector<std::string> inputs(const Edit_options& options) {
    std::vector<std::string> names = options.bodies;
    names.push_back(options.environment);
    names.push_back(options.changes);
    return names;
  }
};

template <int D>
void edit_environment(const Edit_options& options, Edit_files& files, Environment<D>& environment,
                      const Groups<D>& groups) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const Environment_changes<D> changes = io::read_changes<D>(options.changes);
  Change_schedule<D> schedule =
      naming(options.changes, [&] { return Change_schedule<D>(snapshot, changes, groups); });
  const Lasting_groups<D> lasting(snapshot, groups);
  Standing_bodies<D> bodies(options.bodies, snapshot);
  std::optional<Changes_table<D>> table;
  if (files.report)
    table.emplace(snapshot, *files.report);
  else
    table.emplace(snapshot);
  {
    const Progress progress("changing the environment");
    Reshaping<D> reshaping(environment, bodies.residents());
    const std::vector<Change_outcome> outcomes = schedule.apply(snapshot, reshaping, 1);
    reshaping.finish();
    table->add(0, outcomes);
  }
  const Certificate certificate = [&] {
    const Progress progress("certifying " + options.output);
    return naming(options.output, [&] { return environment.certify(); });
  }();
  write_environment<D>(*files.environment, environment, certificate, lasting.now(snapshot));
  nlohmann::ordered_json json{{"environment", options.output}, {"certificate", to_json(certificate, D)}};
  json["changes"] = table->to_json();
  json["bodies"] = bodies.to_json();
  write_json(files.json, json);
  std::string text = fmt::format("{}: certified, {}D\n{}  {:<12}{}\n", options.output, D,
                                 describe(certificate, D), "changes", table->describe());
  if (!bodies.empty()) text += fmt::format("  {:<12}{}\n", "bodies", bodies.describe());
  for (const std::string& note : bodies.notes()) text += fmt::format("  {:<12}{}\n", "note", note);
  files.all.commit(text);
}

void edit(const Edit_options& options) {
  Edit_files files(options);
  Loaded_environment loaded = load_with_progress(options.environment, options.build);
  std::visit(
      [&]<int D>(Environment<D>& environment) {
        edit_environment(options, files, environment, std::get<Groups<D>>(loaded.groups));
      },
      loaded.environment);
}

}  // namespace

void add_edit(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<Edit_options>();
  CLI::App* command = app.add_subcommand(
      "edit", "Open and close facets of an environment, excavate and fill cells, as far as bodies allow");
  command->add_option("environment", options->environment, "A certified environment")
      ->required()
      ->type_name("ENV");
  command
      ->add_option("changes", options->changes,
                   "What is to be opened, closed, excavated and filled, in order; see docs/cutting.md")
      ->required()
      ->type_name("CHANGES.json");
  add_environment_output(*command, options->output);
  command
      ->add_option("--body", options->bodies,
                   "A body that stands in the environment where its file has it; may be given several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
  command
      ->add_option("--report", options->report,
                   "What came of each facet and cell, and what holds those that were refused")
      ->type_name("OUT.csv");
  add_duplicates(*command, options->build.duplicates);
  add_json(*command, options->json);
  add_examples(*command, {"cellwalk edit rooms.ovm close.json -o closed.ovm",
                          "cellwalk edit vessel.ovm valve.json -o shut.ovm --body catheter.obj --report "
                          "valve.csv"});
  command->callback([options, &chosen] { chosen = [options] { edit(*options); }; });
}

}  // namespace cellwalk::cli
