// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "common/confidence.h"
#include "common/manifest.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "face_trials.h"
#include "sweep_trials.h"

namespace cellwalk::small_obstacles {
namespace {

using experiments::confidence_interval;
using experiments::part_seed;

constexpr std::array sizes_over_step{0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 1.5};
constexpr std::array edges_over_step{1.0, 4.0};
constexpr std::array sharpnesses{1.0, 2.0, 4.0, 8.0, 16.0, 32.0};
constexpr std::array sizes_over_inradius{0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};

/// How many trials there are in a row.
struct Lengths {
  std::uint64_t moves, spike_faces, worst_faces, floating_faces;
};
constexpr Lengths quick_lengths{20'000, 200, 40, 200}, full_lengths{1'000'000, 5'000, 500, 5'000};

constexpr std::array sweep_names{"three_segments", "complete"};

/// Six digits: what differs in the last bits between libraries is not written.
std::string text(double value) { return fmt::format("{:.6g}", value); }

struct Rows {
  std::vector<Sweep_setting> sweep_settings;
  std::vector<Sweep_tally> sweeps;
  std::vector<Spike_setting> spike_settings;
  std::vector<Spike_tally> spikes;
  std::vector<Floating_setting> floating_settings;
  std::vector<Floating_tally> floating;
};

Rows plan_rows(const Plan& plan) {
  const Lengths& lengths = plan.quick ? quick_lengths : full_lengths;
  Rows rows;
  for (const int dimension : {2, 3})
    for (const double edge : edges_over_step)
      for (const double size : sizes_over_step)
        rows.sweep_settings.push_back({dimension, 0.5, edge, size,
                                       part_seed(plan.seed, "sweeps", rows.sweep_settings.size()),
                                       lengths.moves});
  for (const Aim aim : {Aim::random, Aim::worst})
    for (const double sharpness : sharpnesses)
      rows.spike_settings.push_back({sharpness, aim,
                                     part_seed(plan.seed, "spikes", rows.spike_settings.size()),
                                     aim == Aim::random ? lengths.spike_faces : lengths.worst_faces});
  for (const double size : sizes_over_inradius)
    rows.floating_settings.push_back(
        {size, part_seed(plan.seed, "floating", rows.floating_settings.size()), lengths.floating_faces});
  return rows;
}

template <class Setting, class Tally, class Run>
void run_rows(const std::vector<Setting>& settings, std::vector<Tally>& tallies, Run run) {
  tallies = experiments::shared_trials(settings.size(), [&](std::size_t i) { return run(settings[i]); });
}

void write_sweeps(const Rows& rows, const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "sweeps.csv",
                     {"dimension", "edge_over_step", "size_over_step", "draws", "sweeps", "contacts",
                      "expected_contacts", "vertex_contacts", "edge_contacts", "missed", "late",
                      "false_contacts", "missed_share", "missed_share_low", "missed_share_high"});
  for (std::size_t i = 0; i < rows.sweeps.size(); ++i) {
    const Sweep_setting& s = rows.sweep_settings[i];
    const Sweep_tally& t = rows.sweeps[i];
    const auto [low, high] = confidence_interval(t.missed, t.edge_contacts);
    out.row(s.dimension, s.edge_over_step, s.size_over_step, s.draws, t.sweeps,
            t.edge_contacts + t.vertex_contacts, text(t.expected_contacts), t.vertex_contacts,
            t.edge_contacts, t.missed, t.late, t.false_contacts,
            t.edge_contacts ? text(static_cast<double>(t.missed) / static_cast<double>(t.edge_contacts)) : "",
            text(low), text(high));
  }
  out.commit();
}

void write_costs(const Rows& rows, const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "costs.csv", {"dimension", "edge_over_step", "size_over_step", "sweep",
                                            "sweeps", "edges", "same_cell", "same_chain", "event_sweeps",
                                            "walks", "crossings", "signs", "exact_signs"});
  for (std::size_t i = 0; i < rows.sweeps.size(); ++i)
    for (std::size_t k = 0; k < sweep_names.size(); ++k) {
      const Sweep_setting& s = rows.sweep_settings[i];
      const Edge_counts& c = rows.sweeps[i].cost[k].counts;
      out.row(s.dimension, s.edge_over_step, s.size_over_step, sweep_names[k], rows.sweeps[i].sweeps, c.edges,
              c.same_cell, c.same_chain, c.event_sweeps, c.walk.walks, c.walk.crossings,
              c.walk.predicates.orientations, c.walk.predicates.fallbacks);
    }
  out.commit();
}

void write_timings(const Rows& rows, const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "timings.csv",
                     {"dimension", "edge_over_step", "size_over_step", "sweep", "ns_per_sweep"});
  for (std::size_t i = 0; i < rows.sweeps.size(); ++i)
    for (std::size_t k = 0; k < sweep_names.size(); ++k) {
      const Sweep_setting& s = rows.sweep_settings[i];
      out.row(s.dimension, s.edge_over_step, s.size_over_step, sweep_names[k],
              text(rows.sweeps[i].cost[k].nanoseconds));
    }
  out.commit();
}

void write_spikes(const Rows& rows, const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "spikes.csv",
                     {"aim", "sharpness", "faces", "not_stopped", "not_pierced", "pierced", "bound",
                      "depth_mean", "depth_median", "depth_max", "share_of_bound_median",
                      "share_of_bound_max", "beyond_bound", "pierced_with_faces", "stopped_by_face"});
  for (std::size_t i = 0; i < rows.spikes.size(); ++i) {
    const Spike_setting& s = rows.spike_settings[i];
    const Spike_tally& t = rows.spikes[i];
    std::vector<double> depths, shares;
    double sum = 0;
    for (const Penetration& p : t.by_edges) {
      depths.push_back(p.depth);
      shares.push_back(p.share);
      sum += p.depth;
    }
    std::sort(depths.begin(), depths.end());
    std::sort(shares.begin(), shares.end());
    const std::size_t n = depths.size();
    out.row(s.aim == Aim::random ? "random" : "worst", s.sharpness, s.faces, t.not_stopped, t.not_pierced, n,
            text(t.bound), n ? text(sum / static_cast<double>(n)) : "", n ? text(depths[n / 2]) : "",
            n ? text(depths.back()) : "", n ? text(shares[n / 2]) : "", n ? text(shares.back()) : "",
            std::count_if(shares.begin(), shares.end(), [](double share) { return share > 1; }),
            t.pierced_with_faces, t.stopped_by_face);
  }
  out.commit();
}

void write_floating(const Rows& rows, const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "floating.csv",
                     {"size_over_inradius", "faces", "stopped", "passed", "passed_with_faces", "passed_share",
                      "passed_share_low", "passed_share_high"});
  for (std::size_t i = 0; i < rows.floating.size(); ++i) {
    const Floating_tally& t = rows.floating[i];
    const std::uint64_t faces = rows.floating_settings[i].faces;
    const auto [low, high] = confidence_interval(t.passed, faces);
    out.row(rows.floating_settings[i].size_over_inradius, faces, t.stopped, t.passed, t.passed_with_faces,
            text(static_cast<double>(t.passed) / static_cast<double>(faces)), text(low), text(high));
  }
  out.commit();
}

}  // namespace

void run(const Plan& plan, const std::filesystem::path& folder) {
  Rows rows = plan_rows(plan);
  {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(plan.threads));
    run_rows(rows.sweep_settings, rows.sweeps, run_sweeps);
    run_rows(rows.spike_settings, rows.spikes, run_spikes);
    run_rows(rows.floating_settings, rows.floating, run_floating);
  }
  write_sweeps(rows, folder);
  write_costs(rows, folder);
  write_spikes(rows, folder);
  write_floating(rows, folder);
  if (plan.rounds > 0 && experiments::ranks().is_first()) {
    for (std::size_t i = 0; i < rows.sweeps.size(); ++i)
      time_sweeps(rows.sweep_settings[i], plan.rounds, rows.sweeps[i]);
    write_timings(rows, folder);
  }
  auto manifest = experiments::manifest(plan.commit);
  manifest["quick"] = plan.quick;
  manifest["seed"] = plan.seed;
  manifest["rounds"] = plan.rounds;
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::small_obstacles
