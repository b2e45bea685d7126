// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>

#include <CGAL/version.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

#include "common/manifest.h"
#include "common/order_statistics.h"
#ifdef CELLWALK_WITH_EMBREE
#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore_config.h>
#else
#include <embree4/rtcore_config.h>
#endif
#endif

namespace cellwalk::real_scenes {
namespace {

/// What is the same on every machine, but for rows that say otherwise.
std::string answer_columns(const Result& result, const Row& row) {
  return fmt::format("{},{},{},{},{},{},{},{},{}", result.scene, row.method, row.margin, result.bodies,
                     result.vertices, result.moves(), result.blocked, row.missed, row.reported);
}
constexpr const char* answer_header = "scene,method,margin_steps,bodies,vertices,moves,blocked,missed,false";

std::string answers(const std::vector<Result>& results) {
  std::string text = answer_header + std::string("\n");
  for (const Result& result : results)
    for (const Row& row : result.rows)
      if (row.is_reproducible) text += answer_columns(result, row) + "\n";
  return text;
}

std::string time_columns(const Row& row) {
  if (row.rounds.empty()) return ",,,,,,";
  using experiments::quantile;
  const double middle = quantile(row.step_us, 0.5), longest = quantile(row.step_us, 1);
  return fmt::format("{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f}", experiments::median(row.rounds),
                     *std::ranges::min_element(row.rounds), middle, quantile(row.step_us, 0.99),
                     quantile(row.step_us, 0.999), longest, longest / middle);
}

std::string work_columns(const Row& row) {
  if (!row.counts) return ",,,,,,,";
  const Body_counts& c = *row.counts;
  const Edge_counts& e = c.edges;
  return fmt::format("{:.3f},{},{},{},{},{},{},{}", row.edge_cells, c.in_region, c.regions, c.region_cells,
                     e.edges, e.walk.walks, e.walk.crossings, e.walk.predicates.fallbacks);
}

std::string csv(const std::vector<Result>& results, int rounds) {
  std::string text = answer_header;
  text +=
      ",library,exact,cells,walls,edges,steps,step_length,ns_per_vertex_move,ns_least,step_us_median,"
      "step_us_p99,step_us_p999,step_us_max,step_max_over_median,build_ms,bytes,edge_cells,in_region,regions,"
      "region_cells,edges_checked,"
      "walks,crossings,fallbacks";
  for (int i = 1; i <= rounds; ++i) text += fmt::format(",ns_round_{}", i);
  text += '\n';
  for (const Result& result : results)
    for (const Row& row : result.rows) {
      text += answer_columns(result, row);
      text += fmt::format(",{},{},{},{},{},{},{:.6g},", row.library, row.is_exact ? 1 : 0, result.cells,
                          result.walls, result.edges, result.steps, result.step_length);
      text += time_columns(row);
      text += fmt::format(",{:.2f},{},", row.build.milliseconds, row.build.bytes) + work_columns(row);
      for (std::size_t i = 0; i < static_cast<std::size_t>(rounds); ++i)
        text += i < row.rounds.size() ? fmt::format(",{:.2f}", row.rounds[i]) : ",";
      text += '\n';
    }
  return text;
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const Measure_options& options, const std::string& commit) {
  nlohmann::ordered_json manifest = experiments::manifest(commit);
  manifest["threads"] = 1;
  manifest["rounds"] = options.rounds;
  manifest["versions"]["cgal"] = CGAL_VERSION_STR;
#ifdef CELLWALK_WITH_BULLET
  manifest["versions"]["bullet"] = CELLWALK_WITH_BULLET;
#endif
#ifdef CELLWALK_WITH_FCL
  manifest["versions"]["fcl"] = CELLWALK_WITH_FCL;
#endif
#ifdef CELLWALK_WITH_EMBREE
  manifest["versions"]["embree"] = RTC_VERSION_STRING;
#endif
  io::write_file(folder / "real_scenes.csv", csv(results, options.rounds));
  io::write_file(folder / "answers.csv", answers(results));
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::real_scenes
