// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves the walls of vessels of several sizes, asks all methods what they pass through, and writes
// moving_walls.csv, answers.csv and manifest.json.
//
//   moving_walls -o DIR [--quick] [--counts] [--rounds N] [--scenes REGEX] [--spoil WHAT] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <span>
#include <string>
#include <vector>

#include "common/order_statistics.h"
#include "common/shared.h"
#include "report.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::moving_walls;

struct Size {
  const char* name;
  double cell_size;  ///< in radii of the trunk
  int judged;        ///< every so many steps are judged
};
constexpr Size full_sizes[] = {
    {"coarse", 0.5, 1}, {"middle", 0.25, 1}, {"fine", 0.125, 4}, {"finest", 0.08, 8}};
constexpr Size quick_sizes[] = {{"coarse", 0.5, 1}, {"middle", 0.35, 1}};
constexpr Movers all_movers[] = {Movers::one, Movers::hundred, Movers::branch, Movers::all};
constexpr int full_steps = 32, quick_steps = 8;

struct Arguments {
  std::string folder, scenes, commit = "unknown";
  bool is_quick = false, is_untimed = false;
  Measure_options options;
};

void print(const Result& r) {
  fmt::print("{}: {} cells, {} wall triangles, {} moves, {} judged, {} blocked, {} dropped\n", r.scene,
             r.cells, r.walls, r.moves, r.judged.moves, r.judged.blocked, r.dropped);
  using experiments::median;
  for (const Row& row : r.rows)
    if (row.arithmetic == Arithmetic::exact)
      fmt::print("  {:<16}{:<8}{:>10.1f}{:>10.1f}{:>10.1f} us {:>9} pairs {:>7} missed {:>7} false\n",
                 row.method, name_of(row.arithmetic), median(row.times.update), median(row.times.query),
                 median(row.times.answer), row.pairs, row.tally.missed, row.tally.reported);
  std::fflush(stdout);
}

/// A scene to be measured.
struct Wanted {
  Size size;
  Movers movers;
  std::string name;
};

std::vector<Wanted> wanted_scenes(const Arguments& arguments) {
  const auto sizes =
      arguments.is_quick ? std::span<const Size>(quick_sizes) : std::span<const Size>(full_sizes);
  std::vector<Wanted> scenes;
  for (const Size& size : sizes)
    for (const Movers movers : all_movers) {
      const std::string name = fmt::format("{}_{}", size.name, name_of(movers));
      if (std::regex_search(name, std::regex(arguments.scenes))) scenes.push_back({size, movers, name});
    }
  return scenes;
}

Result measure_scene(const Wanted& wanted, const Arguments& arguments) {
  const Vessel_options vessel{.generations = 1, .cell_size = wanted.size.cell_size};
  const Cell_soup<3> soup = branching_vessel(vessel);
  Measure_options options = arguments.options;
  options.judged = wanted.size.judged;
  return measure([&] { return std::make_unique<Scene>(soup, vessel, wanted.movers); }, wanted.name,
                 name_of(wanted.movers), options);
}

void run(const Arguments& arguments, const std::filesystem::path& folder) {
  if (experiments::is_idle(arguments.options.is_timed)) return;
  // All methods use one thread, so that their processor times can be compared.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<Wanted> scenes = wanted_scenes(arguments);
  // While all is on this rank, what is done is printed and written before the next scene begins.
  const bool is_alone = arguments.options.is_timed || experiments::ranks().is_alone();
  std::vector<Result> results;
  const auto trial = [&](std::size_t i) {
    Result result = measure_scene(scenes[i], arguments);
    if (!is_alone) return result;
    print(result);
    results.push_back(result);
    write_report(folder, results, arguments.options, arguments.commit);
    return result;
  };
  const auto all = experiments::shared_trials(
      scenes.size(), trial,
      arguments.options.is_timed ? experiments::Trials::timed : experiments::Trials::in_order);
  if (is_alone) return;
  for (const Result& result : all) print(result);
  write_report(folder, all, arguments.options, arguments.commit);
}

}  // namespace

int main(int argc, char** argv) {
  experiments::silence_later_ranks();
  CLI::App app("Moves walls among bodies, and asks all methods what they pass through");
  Arguments arguments;
  const std::map<std::string, Spoiled> spoiled{{"hits", Spoiled::hits}, {"boxes", Spoiled::boxes}};
  app.add_option("-o,--out", arguments.folder, "folder for the results")->required();
  app.add_flag("--quick", arguments.is_quick, "small vessels: what the test compares");
  app.add_flag("--counts", arguments.is_untimed, "nothing that is timed");
  app.add_option("--rounds", arguments.options.rounds, "of each motion")->check(CLI::PositiveNumber);
  app.add_option("--scenes", arguments.scenes, "scenes whose names match a regular expression");
  app.add_option("--spoil", arguments.options.spoiled, "answers changed, so that tests see the judge find it")
      ->transform(CLI::CheckedTransformer(spoiled));
  app.add_option("--commit", arguments.commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  arguments.options.is_timed = !arguments.is_untimed;
  arguments.options.steps = arguments.is_quick ? quick_steps : full_steps;
  return experiments::run_on_ranks("moving_walls", arguments.folder, [&](const auto& folder) {
    run(arguments, folder);
    return 0;
  });
}
