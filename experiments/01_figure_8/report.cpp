// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

#include "common/manifest.h"

namespace cellwalk::figure_8 {
namespace {

std::string csv(const std::vector<Result>& results, int rounds) {
  std::string text =
      "trace,cells,solid_cells,walls,body_side,bodies,steps,moves,held,method,reproducible,hits,missed,false,"
      "ns_per_vertex_move,us_per_step,build_ms,bytes,bytes_per,unit,boxes,queries,triangle_tests,walks,"
      "crossings,signs,"
      "fallbacks,certified_edges,clear_moves";
  for (int i = 1; i <= rounds; ++i) text += fmt::format(",ns_round_{}", i);
  text += '\n';
  for (const Result& result : results)
    for (const Row& row : result.rows) {
      const std::uint64_t units = row.build.per == std::string_view("wall") ? result.walls : result.cells;
      text += fmt::format("{},{},{},{},{},{},{},{},{},", result.trace, result.cells, result.solid_cells,
                          result.walls, result.body_side, result.bodies, result.steps, result.moves(),
                          result.held);
      text += fmt::format("{},{},{},{},{},", row.method, row.is_reproducible ? 1 : 0, row.hits,
                          row.wrong.missed, row.wrong.reported);
      const double moves_a_step = static_cast<double>(result.bodies) * trace_vertices;
      text += row.rounds.empty()
                  ? ",,"
                  : fmt::format("{:.3f},{:.3f},", row.median(), row.median() * moves_a_step / 1e3);
      text += fmt::format("{:.2f},{},{:.1f},{},", row.build.milliseconds, row.build.bytes,
                          static_cast<double>(row.build.bytes) / static_cast<double>(units), row.build.per);
      const Counts& c = row.counts;
      text += fmt::format("{},{},{},{},{},{},{},{},{}", c.boxes, c.queries, c.triangle_tests, c.walks,
                          c.crossings, c.signs, c.fallbacks, c.certified_edges, c.clear_moves);
      for (int i = 0; i < rounds; ++i)
        text += i < static_cast<int>(row.rounds.size())
                    ? fmt::format(",{:.3f}", row.rounds[static_cast<std::size_t>(i)])
                    : ",";
      text += '\n';
    }
  return text;
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const std::vector<Family>& families, const Measure_options& options,
                  const std::string& commit) {
  nlohmann::ordered_json manifest = experiments::manifest(commit);
  manifest["threads"] = 1;
  manifest["rounds"] = options.rounds;
  for (const Family& family : families)
    if (!family.version.empty()) manifest["versions"][family.name] = family.version;
  for (const Result& r : results)
    manifest["traces"].push_back({{"name", r.trace},
                                  {"cells", r.cells},
                                  {"solid_cells", r.solid_cells},
                                  {"wall_triangles", r.walls},
                                  {"bodies", r.bodies},
                                  {"body_side", r.body_side},
                                  {"speed", r.speed},
                                  {"steps", r.steps},
                                  {"held", r.held},
                                  {"seed", r.seed}});
  io::write_file(folder / "figure_8.csv", csv(results, options.rounds));
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::figure_8
