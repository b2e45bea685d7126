// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the experiment and writes errors.csv, costs.csv, manifest.json and, if it is to be timed,
// timings.csv.
//
//   contact_search -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "report.h"

int main(int argc, char** argv) {
  using namespace cellwalk::contact_search;
  CLI::App app("Searches for contacts, compared with the exact one");
  std::string folder;
  Plan plan;
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_flag("--quick", plan.quick, "few contacts: what the test compares");
  app.add_option("--threads", plan.threads,
                 "worlds at the same time, unless timed; results do not depend on it")
      ->check(CLI::PositiveNumber);
  app.add_option("--rounds", plan.rounds, "timed rounds of each search; 0: no times")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seed", plan.seed, "of everything random");
  app.add_option("--commit", plan.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    run(plan, folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "contact_search: {}\n", error.what());
    return 1;
  }
}
