// SPDX-License-Identifier: LGPL-3.0-or-later
// The program of an experiment that runs a plan.
#ifndef CELLWALK_EXPERIMENTS_COMMON_MAIN_H
#define CELLWALK_EXPERIMENTS_COMMON_MAIN_H

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

#include "plan.h"
#include "shared.h"

namespace cellwalk::experiments {

/// Descriptions for --help, as far as they differ.
struct Descriptions {
  std::string program, quick, threads, rounds;
};

/// The program PROGRAM -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]: makes the
/// folder and runs the plan, run(plan, folder), on every rank. Returns its exit code; a failure is printed.
template <class Run>
int run_program(int argc, char** argv, const std::string& name, const Descriptions& descriptions, Run run) {
  silence_later_ranks();
  CLI::App app(descriptions.program);
  std::string folder;
  Plan plan;
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_flag("--quick", plan.quick, descriptions.quick);
  app.add_option("--threads", plan.threads, descriptions.threads)->check(CLI::PositiveNumber);
  app.add_option("--rounds", plan.rounds, descriptions.rounds)->check(CLI::NonNegativeNumber);
  app.add_option("--seed", plan.seed, "of everything random");
  app.add_option("--commit", plan.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  return run_on_ranks(name, folder, [&](const std::filesystem::path& of_rank) {
    run(plan, of_rank);
    return 0;
  });
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_MAIN_H
