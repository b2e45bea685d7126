// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves the walls of vessels of several sizes, asks all methods what they pass through, and writes
// moving_walls.csv, answers.csv and manifest.json.
//
//   moving_walls -o DIR [--quick] [--counts] [--rounds N] [--scenes REGEX] [--spoil WHAT] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <span>
#include <string>
#include <vector>

#include "common/order_statistics.h"
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

void run(const Arguments& arguments) {
  // All methods use one thread, so that their processor times can be compared.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<Result> results;
  const auto sizes =
      arguments.is_quick ? std::span<const Size>(quick_sizes) : std::span<const Size>(full_sizes);
  for (const Size& size : sizes) {
    const Vessel_options vessel{.generations = 1, .cell_size = size.cell_size};
    std::optional<Cell_soup<3>> soup;
    for (const Movers movers : all_movers) {
      const std::string name = fmt::format("{}_{}", size.name, name_of(movers));
      if (!std::regex_search(name, std::regex(arguments.scenes))) continue;
      if (!soup) soup = branching_vessel(vessel);
      Measure_options options = arguments.options;
      options.judged = size.judged;
      results.push_back(measure([&] { return std::make_unique<Scene>(*soup, vessel, movers); }, name,
                                name_of(movers), options));
      print(results.back());
      write_report(arguments.folder, results, arguments.options, arguments.commit);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
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
  try {
    arguments.options.is_timed = !arguments.is_untimed;
    arguments.options.steps = arguments.is_quick ? quick_steps : full_steps;
    std::filesystem::create_directories(arguments.folder);
    run(arguments);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "moving_walls: {}\n", error.what());
    return 1;
  }
}
