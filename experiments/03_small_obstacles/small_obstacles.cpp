// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the experiment and writes sweeps.csv, costs.csv, spikes.csv, floating.csv, manifest.json and, if it is
// to be timed, timings.csv.
//
//   small_obstacles -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "report.h"

int main(int argc, char** argv) {
  using namespace cellwalk::small_obstacles;
  CLI::App app("What three segments and edges without faces miss among small obstacles");
  std::string folder;
  Plan plan;
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_flag("--quick", plan.quick, "few trials: what the test compares");
  app.add_option("--threads", plan.threads, "rows at the same time; nothing but times depends on it")
      ->check(CLI::PositiveNumber);
  app.add_option("--rounds", plan.rounds, "timed rounds of each sweep; 0: no times")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seed", plan.seed, "of everything random");
  app.add_option("--commit", plan.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    run(plan, folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "small_obstacles: {}\n", error.what());
    return 1;
  }
}
