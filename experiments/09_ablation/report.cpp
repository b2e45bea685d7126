// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates.h"
#include "common/confidence.h"
#include "common/manifest.h"
#include "common/order_statistics.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "flights.h"
#include "forms.h"
#include "orders.h"
#include "segments.h"

namespace cellwalk::ablation {
namespace {

using experiments::part_seed;
using experiments::Plan;
using experiments::shared_trials;
using experiments::Trials;
using real_scenes::Scene_entry;
namespace fs = std::filesystem;

/// Six digits: what differs in the last bits between libraries is not written.
std::string text(double value) { return fmt::format("{:.6g}", value); }

/// The median of the rounds; nothing where none was timed.
std::string time_text(const std::vector<double>& rounds) {
  return rounds.empty() ? "" : fmt::format("{:.2f}", experiments::median(rounds));
}

void refuse(std::uint64_t different, const std::string& what) {
  if (different > 0) throw std::runtime_error(fmt::format("{}: {} answers are different", what, different));
}

template <class Row>
std::vector<Row> joined(const std::vector<std::vector<Row>>& parts) {
  std::vector<Row> rows;
  for (const std::vector<Row>& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

void write_certificates(const std::vector<Scene_entry>& scenes, int rounds, const fs::path& folder) {
  const auto rows = joined(shared_trials(
      scenes.size(),
      [&](std::size_t i) { return run_certificates(scenes[i].name, load_scene(scenes[i]), rounds); },
      rounds > 0 ? Trials::timed : Trials::on_threads));
  io::Csv_writer out(
      folder / "certificates.csv",
      {"scene",      "regions",         "certificates", "moves",        "held",      "different",
       "in_region",  "region_searches", "region_cells", "region_walls", "edges",     "same_cell",
       "same_chain", "relinked",        "event_sweeps", "walks",        "crossings", "plane_blocks",
       "side_tests", "along_tests",     "signs",        "exact_signs"});
  for (const Certificate_row& r : rows) {
    refuse(r.different, r.scene + ", " + r.chosen);
    const Body_counts& c = r.counts;
    const Edge_counts& e = c.edges;
    const Walk_counts& w = e.walk;
    out.row(r.scene, r.regions ? 1 : 0, r.chosen, c.moves, c.held, r.different, c.in_region,
            c.regions + c.no_region, c.region_cells, c.region_walls, e.edges, e.same_cell, e.same_chain,
            e.relinked, e.event_sweeps, w.walks, w.crossings, w.plane_blocks, w.side_tests, w.along_tests,
            w.predicates.orientations, w.predicates.fallbacks);
  }
  out.commit();
  if (rounds == 0) return;
  io::Csv_writer times(folder / "certificate_times.csv",
                       {"scene", "regions", "certificates", "ns_per_vertex_move"});
  for (const Certificate_row& r : rows)
    times.row(r.scene, r.regions ? 1 : 0, r.chosen, time_text(r.nanoseconds));
  times.commit();
}

void write_flights(const Plan& plan, int rounds, const fs::path& folder) {
  std::vector<Flight_setting> settings;
  for (const char* world : {"vessel", "hexahedra"})
    for (const double length : {0.05, 0.5, 4.0})
      settings.push_back({world, plan.quick, length, plan.quick ? std::size_t{2'000} : std::size_t{100'000},
                          5, part_seed(plan.seed, "flights", settings.size())});
  const auto rows = joined(shared_trials(
      settings.size(), [&](std::size_t i) { return run_flights(settings[i], rounds); },
      rounds > 0 ? Trials::timed : Trials::on_threads));
  io::Csv_writer out(folder / "flights.csv", {"world", "cells", "length_over_edge", "way", "moves", "blocked",
                                              "different", "crossings", "plane_blocks", "uncertain_planes",
                                              "side_tests", "along_tests", "turns", "signs", "exact_signs"});
  for (const Flight_row& r : rows) {
    refuse(r.different, r.world + ", " + r.way);
    const Walk_counts& c = r.counts;
    out.row(r.world, r.cells, r.length, r.way, r.moves, r.blocked, r.different, c.crossings, c.plane_blocks,
            c.uncertain_lanes, c.side_tests, c.along_tests, c.turns, c.predicates.orientations,
            c.predicates.fallbacks);
  }
  out.commit();
  if (rounds == 0) return;
  io::Csv_writer times(folder / "flight_times.csv", {"world", "length_over_edge", "way", "ns_per_move"});
  for (const Flight_row& r : rows) times.row(r.world, r.length, r.way, time_text(r.nanoseconds));
  times.commit();
}

void write_orders(const Plan& plan, const fs::path& folder) {
  struct World {
    const char* name;
    double size, edge;
  };
  constexpr std::array worlds{World{"boxes", 0.0625, 0.5}, World{"boxes", 0.25, 0.5}, World{"cubes", 1, 0.3}};
  std::vector<Order_setting> settings;
  for (const World& world : worlds)
    for (const Motion_kind motion : {Motion_kind::shift, Motion_kind::turn, Motion_kind::independent})
      for (const double step : {0.03125, 0.125, 0.5, 1.0, 2.0})
        settings.push_back({world.name, world.size, motion, world.edge, step,
                            part_seed(plan.seed, "orders", settings.size()),
                            plan.quick ? std::uint64_t{500} : std::uint64_t{20'000}});
  const auto tallies = shared_trials(settings.size(), [&](std::size_t i) { return run_orders(settings[i]); });
  io::Csv_writer out(folder / "orders.csv", {"world",
                                             "size",
                                             "motion",
                                             "edge",
                                             "step_over_edge",
                                             "draws",
                                             "made",
                                             "together",
                                             "p_first",
                                             "q_first",
                                             "p_first_only",
                                             "together_only",
                                             "orders_differ",
                                             "any_order_only",
                                             "no_order",
                                             "wrong",
                                             "undecided",
                                             "p_first_only_share",
                                             "p_first_only_low",
                                             "p_first_only_high",
                                             "together_only_share",
                                             "together_only_low",
                                             "together_only_high"});
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Order_setting& s = settings[i];
    const Order_tally& t = tallies[i];
    refuse(t.wrong, fmt::format("orders, row {}", i));
    const auto share = [&t](std::uint64_t count) {
      return text(t.made ? static_cast<double>(count) / static_cast<double>(t.made) : 0);
    };
    const auto only = experiments::confidence_interval(t.p_first_only, t.made),
               together = experiments::confidence_interval(t.together_only, t.made);
    out.row(s.world, s.size, motion_names[static_cast<std::size_t>(s.motion)], s.edge, s.step_over_edge,
            s.draws, t.made, t.together, t.p_first, t.q_first, t.p_first_only, t.together_only,
            t.orders_differ, t.any_order_only, t.no_order, t.wrong, t.undecided, share(t.p_first_only),
            text(only.low), text(only.high), share(t.together_only), text(together.low), text(together.high));
  }
  out.commit();
}

void write_segments(const std::vector<Scene_entry>& scenes, const fs::path& folder) {
  const auto rows = shared_trials(
      scenes.size(), [&](std::size_t i) { return run_segments(scenes[i].name, load_scene(scenes[i])); });
  io::Csv_writer asked(folder / "asked.csv",
                       {"scene", "moves", "vertices_blocked", "edges", "swept", "at_end", "unseen",
                        "unseen_share", "unseen_low", "unseen_high", "rounds", "wrong", "undecided"});
  io::Csv_writer stops(folder / "stops.csv", {"scene", "sweep", "moves", "contacts", "of_edges", "through",
                                              "steps_through", "undecided"});
  for (const Segment_row& r : rows) {
    const Asked_tally& a = r.asked;
    refuse(a.wrong, r.scene + ", judged");
    refuse(r.complete.through, r.scene + ", moves by the complete sweep through walls");
    const auto interval = experiments::confidence_interval(a.unseen, a.swept);
    asked.row(r.scene, a.moves, a.vertices_blocked, a.edges, a.swept, a.at_end, a.unseen,
              a.swept ? text(static_cast<double>(a.unseen) / static_cast<double>(a.swept)) : "",
              text(interval.low), text(interval.high), a.rounds, a.wrong, a.undecided);
    for (const auto& [name, t] : {std::pair{"three_segments", r.three_segments}, {"complete", r.complete}})
      stops.row(r.scene, name, t.moves, t.contacts, t.of_edges, t.through, t.steps_through, t.undecided);
  }
  asked.commit();
  stops.commit();
}

/// \param data a folder of public meshes, or nothing
void write_forms(const Plan& plan, int rounds, const fs::path& data, const fs::path& folder) {
  const std::vector<Form_setting> settings = form_settings(plan.quick, data, part_seed(plan.seed, "forms"));
  const auto rows = joined(shared_trials(
      settings.size(), [&](std::size_t i) { return run_forms(settings[i], rounds); },
      rounds > 0 ? Trials::timed : Trials::on_threads));
  io::Csv_writer out(folder / "forms.csv", {"mesh", "form", "cells_read", "not_planar", "not_convex", "cells",
                                            "facets", "bytes", "moves", "blocked", "crossings"});
  for (const Form_row& r : rows)
    out.row(r.mesh, r.form, r.cells_read, r.not_planar, r.not_convex, r.cells, r.facets, r.bytes, r.moves,
            r.blocked, r.crossings);
  out.commit();
  if (rounds == 0) return;
  io::Csv_writer times(folder / "form_times.csv", {"mesh", "form", "ns_per_move"});
  for (const Form_row& r : rows) times.row(r.mesh, r.form, time_text(r.nanoseconds));
  times.commit();
}

}  // namespace

void run(const Plan& plan, const Inputs& inputs, const fs::path& folder) {
  const auto is_chosen = [&inputs](const char* part) {
    return inputs.parts.empty() || std::ranges::count(inputs.parts, part) > 0;
  };
  const std::vector<Scene_entry> entries = real_scenes::read_scene_list(inputs.scenes);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(plan.threads));
  if (!experiments::is_idle(plan.rounds > 0)) {
    if (is_chosen("certificates")) write_certificates(entries, plan.rounds, folder);
    if (is_chosen("flights")) write_flights(plan, plan.rounds, folder);
    if (is_chosen("forms")) write_forms(plan, plan.rounds, inputs.data, folder);
  }
  if (is_chosen("segments")) write_segments(entries, folder);
  if (is_chosen("orders")) write_orders(plan, folder);
  auto manifest = experiments::manifest(plan.commit);
  manifest["quick"] = plan.quick;
  manifest["seed"] = plan.seed;
  manifest["rounds"] = plan.rounds;
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::ablation
