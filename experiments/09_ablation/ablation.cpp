// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the experiment and writes certificates.csv, flights.csv, orders.csv, asked.csv, stops.csv, forms.csv,
// manifest.json and, if it is to be timed, certificate_times.csv, flight_times.csv and form_times.csv.
//
//   ablation SCENES.json -o DIR [--part NAME ...] [--data DIR] [--quick] [--threads N] [--rounds N]
//                        [--seed N] [--commit NAME]
#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

#include "common/shared.h"
#include "report.h"

int main(int argc, char** argv) {
  using namespace cellwalk;
  experiments::silence_later_ranks();
  CLI::App app("What the parts of the method are worth, and what moving one vertex at a time means");
  std::string folder;
  ablation::Inputs inputs;
  experiments::Plan plan;
  app.add_option("list", inputs.scenes, "the scenes, as make_scenes.py lists them")->required();
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_option("--data", inputs.data, "a folder of public meshes");
  app.add_option("--part", inputs.parts, "these parts only")->check(CLI::IsMember(ablation::part_names));
  app.add_flag("--quick", plan.quick, "few trials: what the test compares");
  app.add_option("--threads", plan.threads, "rows at the same time; nothing but times depends on it")
      ->check(CLI::PositiveNumber);
  app.add_option("--rounds", plan.rounds, "timed rounds; 0: no times")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", plan.seed, "of everything random");
  app.add_option("--commit", plan.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  return experiments::run_on_ranks("ablation", folder, [&](const std::filesystem::path& of_rank) {
    ablation::run(plan, inputs, of_rank);
    return 0;
  });
}
