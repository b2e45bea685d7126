// SPDX-License-Identifier: LGPL-3.0-or-later
// Judges a very long row of walks, of complete sweeps of edges, or of such with a radius; writes PART.csv and
// PART.json. A run that was stopped goes on where it was.
//
//   endurance -o DIR --part PART --motions N [--threads N] [--seed N] [--commit NAME] [--anew]
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "common/confidence.h"
#include "common/kept_counts.h"
#include "common/manifest.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "trial.h"

namespace cellwalk::endurance {
namespace {

namespace fs = std::filesystem;

struct Part {
  Tally (*judge)(const Trial&);
  std::uint64_t motions_of_world;
};
const std::map<std::string, Part> parts{{"walks", {judge_walks, 20'000}},
                                        {"sweeps", {judge_sweeps, 5'000}},
                                        {"membrane_sweeps", {judge_membrane_sweeps, 5'000}},
                                        {"thick_sweeps", {judge_thick_sweeps, 2'000}}};
/// Finished together, and then kept; so many times the share of a population.
constexpr std::uint64_t worlds_of_chunk = 50;

struct Options {
  std::string part, folder, commit = "unknown";
  std::uint64_t motions = 0, seed = 1;
  std::size_t threads = 1;
  bool is_new = false;

  /// All that the counts of a chunk depend on.
  std::string settings() const {
    return nlohmann::ordered_json{
        {"program", "endurance"}, {"commit", commit}, {"part", part}, {"seed", seed}}
        .dump();
  }
};

class Run {
 public:
  explicit Run(const Options& options)
      : options_(options),
        part_(parts.at(options.part)),
        populations_(populations()),
        tallies_(populations_.size()),
        kept_(fs::path(options.folder) / fmt::format("kept_{}.jsonl", options.part), options.settings(),
              !options.is_new) {}

  /// Returns the number of wrong answers.
  std::uint64_t judge_all() {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options_.threads);
    std::uint64_t in_row = 0;
    for (const Population& p : populations_) in_row += p.share() * part_.motions_of_world;
    const std::uint64_t rows = (options_.motions + in_row - 1) / in_row;
    for (std::uint64_t first = 0; first < rows; first += worlds_of_chunk) {
      const std::uint64_t last = std::min(rows, first + worlds_of_chunk);
      for (std::size_t k = 0; k < populations_.size(); ++k) {
        const std::uint64_t share = populations_[k].share();
        tallies_[k] += chunk(populations_[k], first * share, last * share);
      }
      Tally sum;
      for (const Tally& t : tallies_) sum += t;
      fmt::print("{}: {} judged, {} degenerate, {} blocked, {} wrong\n", options_.part, sum.motions,
                 sum.degenerate, sum.blocked, sum.wrong);
      std::fflush(stdout);
    }
    return write();
  }

 private:
  Tally chunk(const Population& population, std::uint64_t first, std::uint64_t last) {
    return kept_.of<Tally>(fmt::format("{}, worlds {} to {}", population.name(), first, last - 1), [&] {
      Tally sum;
      for (const Tally& of_world : experiments::shared_trials(last - first, [&](std::size_t i) {
             const std::uint64_t seed = experiments::part_seed(
                 options_.seed, fmt::format("{} {}", options_.part, population.name()), first + i);
             return part_.judge(
                 {population, seed, part_.motions_of_world, fs::path(options_.folder) / "wrong"});
           }))
        sum += of_world;
      return sum;
    });
  }

  std::uint64_t write() const {
    io::Csv_writer table(
        fs::path(options_.folder) / (options_.part + ".csv"),
        {"dimension", "cells", "motions", "judged", "degenerate", "blocked", "by_edge", "wrong"});
    nlohmann::ordered_json manifest = experiments::manifest(options_.commit);
    manifest["part"] = options_.part;
    manifest["seed"] = options_.seed;
    Tally sum;
    for (std::size_t k = 0; k < populations_.size(); ++k) {
      const Population& p = populations_[k];
      const Tally& t = tallies_[k];
      table.row(p.dimension, cut_names[static_cast<std::size_t>(p.cut)],
                grid_names[static_cast<std::size_t>(p.grid)], t.motions, t.degenerate, t.blocked, t.by_edge,
                t.wrong);
      sum += t;
    }
    table.commit();
    manifest["judged"] = sum.motions;
    manifest["wrong"] = sum.wrong;
    manifest["wrong_at_most"] = experiments::confidence_interval(sum.wrong, sum.motions).high;
    io::write_json(fs::path(options_.folder) / (options_.part + ".json"), manifest);
    return sum.wrong;
  }

  const Options& options_;
  const Part part_;
  const std::vector<Population> populations_;
  std::vector<Tally> tallies_;
  experiments::Kept_counts kept_;
};

}  // namespace
}  // namespace cellwalk::endurance

int main(int argc, char** argv) {
  using namespace cellwalk;
  experiments::silence_later_ranks();
  CLI::App app("Judges very many walks and sweeps by integer arithmetic");
  endurance::Options options;
  std::vector<std::string> names;
  for (const auto& [name, part] : endurance::parts) names.push_back(name);
  app.add_option("-o,--out", options.folder, "folder for the table, the manifest and the counts kept")
      ->required();
  app.add_option("--part", options.part, "what moves")->required()->check(CLI::IsMember(names));
  app.add_option("--motions", options.motions, "in all; rounded up to whole worlds of each population")
      ->required()
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads, "counts do not depend on it")->check(CLI::Range(1, 1024));
  app.add_option("--seed", options.seed, "of everything");
  app.add_option("--commit", options.commit, "what the manifest names as the source");
  app.add_flag("--anew", options.is_new, "drop the counts that an earlier run left in the folder");
  CLI11_PARSE(app, argc, argv);
  return experiments::run_on_ranks("endurance", options.folder, [&](const auto& folder) {
    options.folder = folder.string();
    return endurance::Run(options).judge_all() == 0 ? 0 : 1;
  });
}
