// SPDX-License-Identifier: LGPL-3.0-or-later
// How often kernels go wrong, judged by the oracle of the tests.
//
//   exact_versus_float -o DIR [--part walks|sweeps|flights|failures|times ...] [--motions N] [--sweeps N]
//                            [--moves N] [--timed N] [--seed S] [--threads N] [--kernel NAME ...]
//                            [--mesh FILE ...] [--resume] [--commit NAME]
#include <cellwalk/internal/io/json_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "common/manifest.h"
#include "common/shared.h"
#include "failures.h"
#include "flights.h"
#include "sweeps.h"
#include "times.h"
#include "walks.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::exact_float;

using experiments::Kept_counts;

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const auto& kernel : kernels<3>()) names.emplace_back(kernel.name);
  return names;
}

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Options {
  std::string folder, commit = "unknown";
  std::vector<std::string> parts{"walks", "sweeps", "flights", "failures", "times"};
  std::uint64_t seed = 1, motions = 1000, sweeps = 500, moves = 10000, timed = 20000;
  std::size_t threads = 1;
  std::vector<std::string> kernels = kernel_names(), meshes;
  bool is_resumed = false;

  bool runs(const char* part) const { return is_in(parts, part); }
  Run_options with(std::uint64_t count, Kept_counts& kept) const {
    Run_options run{folder, seed, count, {}, &kept, {meshes.begin(), meshes.end()}};
    const auto names = kernel_names();
    for (std::size_t k = 0; k < kernel_count; ++k) run.kernels[k] = is_in(kernels, names[k]);
    return run;
  }
  /// All that the counts of walks and sweeps depend on.
  std::string settings() const {
    return nlohmann::ordered_json{{"program", "exact_versus_float"},
                                  {"commit", commit},
                                  {"seed", seed},
                                  {"motions", motions},
                                  {"sweeps", sweeps},
                                  {"kernels", kernels},
                                  {"meshes", meshes}}
        .dump();
  }
};

/// Runs the parts that are wanted; returns how often the exact kernels were wrong.
std::uint64_t run(const Options& options) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options.threads);
  nlohmann::ordered_json manifest = experiments::manifest(options.commit);
  manifest["seed"] = options.seed;
  Kept_counts kept(std::filesystem::path(options.folder) / "kept.jsonl", options.settings(),
                   options.is_resumed);
  std::uint64_t wrong = 0;
  const auto note = [&](const char* part, const Exact_summary& s) {
    manifest["exact"][part] = {{"motions", s.motions}, {"by_exact_kernels", s.by_exact}, {"wrong", s.wrong}};
    wrong += s.wrong;
    fmt::print("{}: {} motions judged, {} answers of exact kernels, {} of them wrong\n", part, s.motions,
               s.by_exact, s.wrong);
  };
  if (options.runs("walks")) note("walks", run_walks(options.with(options.motions, kept)));
  if (options.runs("sweeps")) note("sweeps", run_sweeps(options.with(options.sweeps, kept)));
  if (options.runs("flights")) note("flights", run_flights(options.with(options.moves, kept)));
  if (options.runs("failures")) manifest["failures"] = run_failures(options.with(options.motions, kept));
  if (options.runs("times") && experiments::ranks().is_first()) run_times(options.with(options.timed, kept));
  io::write_json(std::filesystem::path(options.folder) / "manifest.json", manifest);
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  experiments::silence_later_ranks();
  CLI::App app("Counts wrong walks and sweeps of exact and rounded kernels");
  Options options;
  app.add_option("-o,--out", options.folder, "folder for the tables and manifest.json")->required();
  app.add_option("--part", options.parts, "what to run")
      ->check(CLI::IsMember(options.parts))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--motions", options.motions, "walked at each point of the grid")
      ->check(CLI::PositiveNumber);
  app.add_option("--sweeps", options.sweeps, "at each distance from a degeneracy")
      ->check(CLI::PositiveNumber);
  app.add_option("--moves", options.moves, "of each kernel in a long simulation")->check(CLI::PositiveNumber);
  app.add_option("--timed", options.timed, "motions that are timed")->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of everything");
  app.add_option("--threads", options.threads, "tables do not depend on it")->check(CLI::Range(1, 1024));
  app.add_option("--kernel", options.kernels, "which walk, in walks and sweeps")
      ->check(CLI::IsMember(options.kernels))
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--mesh", options.meshes, "a file of cells that is walked in, too")
      ->check(CLI::ExistingFile);
  app.add_flag("--resume", options.is_resumed, "go on with the counts that a stopped run left in the folder");
  app.add_option("--commit", options.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  return experiments::run_on_ranks("exact_versus_float", options.folder, [&](const auto& folder) {
    options.folder = folder.string();
    return run(options) == 0 ? 0 : 1;
  });
}
