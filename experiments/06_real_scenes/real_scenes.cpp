// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays the motions of a list of scenes with all methods, and writes real_scenes.csv, answers.csv and
// manifest.json.
//
//   real_scenes SCENES.json -o DIR [--rounds N] [--seconds S] [--only REGEX] [--scenes REGEX] [--commit NAME]
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "common/order_statistics.h"
#include "common/shared.h"
#include "report.h"
#include "scenes.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::real_scenes;

Result measure_scene(const Scene_entry& entry, const Measure_options& options) {
  const Loaded_scene scene = load_scene(entry);
  const Wall_mesh mesh = experiments::wall_mesh(scene.soup, scene.gluing, experiments::Facing::wall);
  const Body_trace& trace = scene.motion.trace;
  Result result{entry.name,
                scene.soup.cell_count(),
                mesh.triangles.size(),
                trace.bodies.size(),
                trace.vertices(),
                (trace.answers_of_step() - trace.vertices()) / 2,
                trace.steps,
                static_cast<std::uint64_t>(std::ranges::count(scene.motion.blocked, 1)),
                scene.motion.step_length,
                {}};
  result.rows = measure({&scene.soup, &mesh}, scene.motion, options);
  return result;
}

void print(const Result& result) {
  fmt::print("{}: {} cells, {} wall triangles, {} moves, {} blocked\n", result.scene, result.cells,
             result.walls, result.moves(), result.blocked);
  for (const Row& row : result.rows)
    fmt::print("  {:<26}{:>4}{:>10.1f} ns a move {:>9.1f} us p99 a step {:>7} missed {:>7} false\n",
               row.method, row.margin, experiments::median(row.rounds),
               experiments::quantile(row.step_us, 0.99), row.missed, row.reported);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  experiments::silence_later_ranks();
  CLI::App app("Replays recorded motions of real scenes with all methods");
  std::string list, folder, scenes, commit = "unknown";
  Measure_options options;
  app.add_option("list", list, "the scenes, as make_scenes.py lists them")->required();
  app.add_option("-o,--out", folder, "folder for the results")->required();
  app.add_option("--rounds", options.rounds, "timed rounds of each method; 0: answers only")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", options.seconds, "a method that would need longer on a scene gets fewer rounds")
      ->check(CLI::PositiveNumber);
  app.add_option("--only", options.only, "methods whose names match a regular expression");
  app.add_option("--scenes", scenes, "scenes whose names match a regular expression");
  app.add_option("--commit", commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  return experiments::run_on_ranks("real_scenes", folder, [&](const std::filesystem::path& of_rank) {
    const bool is_timed = options.rounds > 0;
    if (experiments::is_idle(is_timed)) return 0;
    std::vector<Scene_entry> entries = read_scene_list(list);
    std::erase_if(entries, [pattern = std::regex(scenes)](const Scene_entry& entry) {
      return !std::regex_search(entry.name, pattern);
    });
    // While all is on this rank, what is done is printed and written before the next scene begins.
    const bool is_alone = is_timed || experiments::ranks().is_alone();
    std::vector<Result> results;
    const auto trial = [&](std::size_t i) {
      Result result = measure_scene(entries[i], options);
      if (!is_alone) return result;
      print(result);
      results.push_back(result);
      write_report(of_rank, results, options, commit);
      return result;
    };
    const auto all = experiments::shared_trials(
        entries.size(), trial, is_timed ? experiments::Trials::timed : experiments::Trials::in_order);
    if (is_alone) return 0;
    for (const Result& result : all) print(result);
    write_report(of_rank, all, options, commit);
    return 0;
  });
}
