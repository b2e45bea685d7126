// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces rays through tetrahedra, judges their lengths, and compares with peers; writes checks.csv,
// threads.csv, failures.csv, manifest.json and, if it is to be timed, times.csv.
//
//   track_lengths -o DIR [--mesh FILE] [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

#include "common/shared.h"
#include "report.h"

int main(int argc, char** argv) {
  using namespace cellwalk;
  experiments::silence_later_ranks();
  CLI::App app("Rays traced through tetrahedra: judged lengths, beside those of peers");
  std::string folder, mesh;
  experiments::Plan plan;
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_option("--mesh", mesh, "a file of tetrahedra to trace rays through, too");
  app.add_flag("--quick", plan.quick, "few rays: what the test compares");
  app.add_option("--threads", plan.threads, "of the checks; nothing depends on it")
      ->check(CLI::PositiveNumber);
  app.add_option("--rounds", plan.rounds, "timed rounds of each method; 0: no times")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seed", plan.seed, "of everything random");
  app.add_option("--commit", plan.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  return experiments::run_on_ranks("track_lengths", folder, [&](const std::filesystem::path& of_rank) {
    track_lengths::run(plan, mesh, of_rank);
    return 0;
  });
}
