// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walks.h"

#include <cellwalk/internal/io/csv.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "common/confidence.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "grid.h"
#include "kernels.h"
#include "scene.h"
#include "tally.h"

namespace cellwalk::exact_float {
namespace {

/// Motions in one world; then another one is made.
constexpr std::uint64_t motions_per_world = 250;

struct Counts {
  std::uint64_t motions = 0, degenerate = 0, blocked = 0;
  std::array<Tally, kernel_count> tallies{};

  void operator+=(const Counts& other) {
    motions += other.motions;
    degenerate += other.degenerate;
    blocked += other.blocked;
    for (std::size_t k = 0; k < kernel_count; ++k) add(tallies[k], other.tallies[k]);
  }
};

/// True if the motion passes or ends on a ridge or vertex, ends on a facet, or runs within one.
template <int D>
bool is_degenerate(const oracle::Trace& trace) {
  return std::any_of(trace.visits.begin(), trace.visits.end(),
                     [&](const oracle::Visit& v) {
                       return v.dimension_at_last < (v.last == trace.last_event() ? D : D - 1);
                     }) ||
         std::any_of(trace.incidences.begin(), trace.incidences.end(),
                     [](const oracle::Incidence& i) { return i.first < i.last; });
}

template <int D>
Counts walk_in_world(const Setting& setting, std::uint64_t seed, std::uint64_t motions,
                     const std::bitset<kernel_count>& walking) {
  Random random(seed);
  const Scene<D> scene(make_world<D>(setting, seed));
  const auto tested = kernels<D>();
  Counts counts;
  while (counts.motions < motions) {
    const Motion<D> way = make_motion(scene.world, setting, random);
    const auto particle = scene.particle_at(way.from, random);
    if (!particle) continue;
    const oracle::Case<D> motion = scene.motion_of(*particle, way.to);
    ++counts.motions;
    counts.degenerate += is_degenerate<D>(motion.trace);
    counts.blocked += motion.truth.arrivals.empty();
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!walking[k]) continue;
      std::vector<Cell> visited;
      Walk_counts ignored;
      const Walk_result<D> result =
          tested[k].walk(scene.snapshot, *particle, way.to, ignored, tested[k].strategy, {&visited});
      const Outcome outcome = outcome_of(scene.oracle, scene.snapshot, motion, result, visited);
      ++counts.tallies[k][static_cast<std::size_t>(outcome)];
    }
  }
  return counts;
}

template <int D>
Counts walk_at(const Grid_point& point, const Run_options& options) {
  const std::uint64_t worlds = (options.count + motions_per_world - 1) / motions_per_world;
  const auto counts = experiments::shared_trials(worlds, [&](std::uint64_t w) {
    const std::uint64_t seed = experiments::part_seed(
        options.seed, fmt::format("walks {} {} {}", D, point.variable, point.value), w);
    return walk_in_world<D>(point.setting, seed,
                            std::min(motions_per_world, options.count - w * motions_per_world),
                            options.kernels);
  });
  Counts sum;
  for (const Counts& c : counts) sum += c;
  return sum;
}

template <int D>
void walk_dimension(const Run_options& options, io::Csv_writer& table, Exact_summary& summary) {
  const auto tested = kernels<D>();
  for (const Grid_point& point : all_points()) {
    const Counts counts =
        options.kept->of<Counts>(fmt::format("walks {}D {} {}", D, point.variable, point.value),
                                 [&] { return walk_at<D>(point, options); });
    summary.motions += counts.motions;
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!options.kernels[k]) continue;
      const Tally& t = counts.tallies[k];
      const auto interval = experiments::confidence_interval(wrong(t), total(t));
      table.row(D, point.variable, point.value, tested[k].name, counts.motions, counts.degenerate,
                counts.blocked, wrong(t), interval.low, interval.high, t[1], t[2], t[3], t[4], t[5], t[6],
                t[7], t[8], t[9], t[10]);
      if (!tested[k].is_exact) continue;
      summary.by_exact += total(t);
      summary.wrong += wrong(t);
    }
    fmt::print("walks {}D {} {}: {} motions", D, point.variable, point.value, counts.motions);
    for (std::size_t k = 0; k < kernel_count; ++k)
      if (options.kernels[k]) fmt::print(", {} {} wrong", tested[k].name, wrong(counts.tallies[k]));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

Exact_summary run_walks(const Run_options& options) {
  std::vector<std::string> columns{"dimension",  "variable", "value", "kernel", "motions",
                                   "degenerate", "blocked",  "wrong", "low",    "high"};
  columns.insert(columns.end(), outcome_names.begin() + 1, outcome_names.end());
  io::Csv_writer table(options.folder / "walks.csv", columns);
  Exact_summary summary;
  walk_dimension<2>(options, table, summary);
  walk_dimension<3>(options, table, summary);
  table.commit();
  return summary;
}

}  // namespace cellwalk::exact_float
