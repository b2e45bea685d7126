// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <CGAL/version.h>
#include <fmt/format.h>
#ifdef CELLWALK_WITH_EMBREE
#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore_config.h>
#else
#include <embree4/rtcore_config.h>
#endif
#endif

#include "common/manifest.h"
#include "common/order_statistics.h"

namespace cellwalk::moving_walls {
namespace {

using experiments::median;

void write_answers(const std::filesystem::path& folder, const std::vector<Result>& results) {
  io::Csv_writer out(folder / "answers.csv", {"scene", "method", "arithmetic", "moves", "dropped", "judged",
                                              "blocked", "touches", "bad_stops", "missed", "false"});
  for (const Result& r : results)
    for (const Row& row : r.rows)
      out.row(r.scene, row.method, name_of(row.arithmetic), r.moves, r.dropped, r.judged.moves,
              r.judged.blocked, r.judged.touches, r.judged.bad_stops, row.tally.missed, row.tally.reported);
  out.commit();
}

/// Of all rounds: update, query, answer, and their sum step by step.
std::vector<double> sums(const Times& times) {
  std::vector<double> result;
  for (std::size_t i = 0; i < times.update.size(); ++i)
    result.push_back(times.update[i] + times.query[i] + times.answer[i]);
  return result;
}

void write_all(const std::filesystem::path& folder, const std::vector<Result>& results, bool is_timed) {
  io::Csv_writer out(folder / "moving_walls.csv", {"scene",        "movers",
                                                   "cells",        "points",
                                                   "walls",        "bodies",
                                                   "edges",        "steps",
                                                   "point_moves",  "moves",
                                                   "dropped",      "judged",
                                                   "blocked",      "judged_pairs",
                                                   "touches",      "bad_stops",
                                                   "method",       "library",
                                                   "arithmetic",   "missed",
                                                   "false",        "answered_blocked",
                                                   "pairs",        "tests",
                                                   "signs",        "exact_signs",
                                                   "update_us",    "query_us",
                                                   "answer_us",    "step_us",
                                                   "step_us_most", "build_ms",
                                                   "bytes"});
  const auto text = [&](double value) { return is_timed ? fmt::format("{:.3f}", value) : std::string(); };
  for (const Result& r : results)
    for (const Row& row : r.rows) {
      const std::vector<double> steps = sums(row.times);
      out.row(r.scene, r.movers, r.cells, r.points, r.walls, r.bodies, r.edges, r.steps, r.point_moves,
              r.moves, r.dropped, r.judged.moves, r.judged.blocked, r.judged.pairs, r.judged.touches,
              r.judged.bad_stops, row.method, row.library, name_of(row.arithmetic), row.tally.missed,
              row.tally.reported, row.tally.blocked, row.pairs, row.tally.tests, row.tally.signs,
              row.tally.exact_signs, text(median(row.times.update)), text(median(row.times.query)),
              text(median(row.times.answer)), text(median(steps)), text(experiments::quantile(steps, 1)),
              text(row.build.milliseconds), is_timed ? std::to_string(row.build.bytes) : "");
    }
  out.commit();
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::vector<Result>& results,
                  const Measure_options& options, const std::string& commit) {
  nlohmann::ordered_json manifest = experiments::manifest(commit);
  manifest["threads"] = 1;
  manifest["rounds"] = options.rounds;
  manifest["steps"] = options.steps;
  manifest["versions"]["cgal"] = CGAL_VERSION_STR;
#ifdef CELLWALK_WITH_BULLET
  manifest["versions"]["bullet"] = CELLWALK_WITH_BULLET;
#endif
#ifdef CELLWALK_WITH_EMBREE
  manifest["versions"]["embree"] = RTC_VERSION_STRING;
#endif
#ifdef CELLWALK_WITH_FCL
  manifest["versions"]["fcl"] = CELLWALK_WITH_FCL;
#endif
  write_answers(folder, results);
  write_all(folder, results, options.is_timed);
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::moving_walls
