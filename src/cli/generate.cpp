// SPDX-License-Identifier: LGPL-3.0-or-later
// cellwalk generate KIND ... -o ENV.ovm: environments made without a file.
#include <cellwalk/internal/io/numbers.h>
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/internal/loading/generators.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <utility>

#include "cli/common/command.h"
#include "cli/common/edge_cells.h"
#include "cli/common/environment_file.h"
#include "cli/common/outputs.h"
#include "cli/common/progress.h"

namespace cellwalk::cli {
namespace {

struct Generate_options {
  Generator_values values;
  std::string environment, json;
  double edge_length = 0;
};

struct Files {
  io::Atomic_file *environment, *json;
};

template <int D>
void write_environment(Cell_soup<D> soup, const Generate_options& options, Outputs& outputs,
                       const Files& files) {
  Build_report report;
  Edge_cells edges;
  {
    const Progress progress("certifying and writing " + options.environment);
    auto environment = Environment<D>::build(std::move(soup), build_of_generated, &report);
    cellwalk::write_environment<D>(*files.environment, environment, report.certificate, {});
    edges = count_edge_cells(environment.snapshot(), {.length = options.edge_length});
  }
  write_json(files.json, {{"environment", options.environment},
                          {"certificate", to_json(report.certificate, D)},
                          {"edge_cells", to_json(edges)}});
  outputs.commit(summary(options.environment, report.certificate, D, edges));
}

std::string default_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : " ") + io::shortest(x);
  return text;
}

void add_option(CLI::App& command, const Generator_option& option, Generator_values& values) {
  std::string name = "--" + option.name;
  std::replace(name.begin(), name.end(), '_', '-');
  if (option.is_flag) {
    command.add_flag_callback(
        name, [&values, key = option.name] { values[key] = {1}; }, option.help);
    return;
  }
  const int most = static_cast<int>(option.initial.size());
  command
      .add_option_function<std::vector<double>>(
          name, [&values, key = option.name](const std::vector<double>& numbers) { values[key] = numbers; },
          option.help + (most > 1 ? "; one number stands for all" : ""))
      ->expected(1, most)
      ->type_name(most > 1 ? "N..." : "N")
      ->default_str(default_text(option.initial));
}

void add_kind(CLI::App& generate_command, const Generator& generator, Action& chosen) {
  const auto options = std::make_shared<Generate_options>();
  CLI::App* command = generate_command.add_subcommand(generator.name, generator.help);
  add_environment_output(*command, options->environment);
  for (const Generator_option& option : generator.options) add_option(*command, option, options->values);
  add_edge_length(*command, options->edge_length);
  add_json(*command, options->json);
  command->callback([options, &chosen, name = generator.name] {
    chosen = [options, name] {
      Outputs outputs({});
      const Files files{outputs.file(options->environment), outputs.file(options->json)};
      std::visit([&](auto soup) { write_environment(std::move(soup), *options, outputs, files); },
                 generate(name, options->values));
    };
  });
}

}  // namespace

void add_generate(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand("generate", "Make an environment that needs no file");
  command->require_subcommand(1);
  for (const Generator& generator : generators()) add_kind(*command, generator, chosen);
  add_examples(*command, {"cellwalk generate vessel -o vessel.ovm",
                          "cellwalk generate hexes --cells 20 20 10 --solid 0.1 --seed 3 -o grid.ovm"});
}

}  // namespace cellwalk::cli
