// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays traces with all methods, in one process, and writes figure_8.csv and manifest.json.
//
//   figure_8 TRACE ... -o DIR [--rounds N] [--seconds S] [--only REGEX] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "report.h"
#include "trace_files.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::figure_8;

/// The moves that walls prevent.
std::uint64_t held(const Trace& trace) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(trace.answers, [](unsigned a) { return (a & segment_bits) != 0; }));
}

Result measure_file(const std::filesystem::path& file, const std::vector<Family>& families,
                    const Measure_options& options) {
  const Trace trace = read_hexahedra(file);
  const Grid_world world = grid_world(trace);
  Result result{file.stem().string(),
                trace.cells(),
                trace.obstacles.size(),
                world.walls.triangles.size(),
                trace.seed,
                trace.body_side,
                trace.speed,
                trace.bodies,
                trace.steps,
                held(trace),
                {}};
  fmt::print("{}: {} cells, {} wall triangles, {} moves, {} held\n", result.trace, result.cells, result.walls,
             result.moves(), result.held);
  result.rows = measure(world, trace, families, options);
  for (const Row& row : result.rows)
    fmt::print("  {:<26}{:>10.1f} ns a move   {:>6} missed {:>6} false of {}\n", row.method, row.median(),
               row.wrong.missed, row.wrong.reported, row.hits);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Replays traces with all methods of figure 8");
  std::vector<std::string> files;
  std::string folder, commit = "unknown";
  Measure_options options;
  app.add_option("traces", files, "trace files")->required();
  app.add_option("-o,--out", folder, "folder for figure_8.csv and manifest.json")->required();
  app.add_option("--rounds", options.rounds, "timed rounds of each method; 0: counts and answers only")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", options.seconds, "a method that would need longer on a trace gets fewer rounds")
      ->check(CLI::PositiveNumber);
  app.add_option("--only", options.only, "methods whose names match a regular expression");
  app.add_option("--commit", commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  try {
    const std::vector<Family> all = families();
    std::filesystem::create_directories(folder);
    std::vector<Result> results;
    for (const std::string& file : files) {
      results.push_back(measure_file(file, all, options));
      write_report(folder, results, all, options, commit);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "figure_8: {}\n", error.what());
    return 1;
  }
}
