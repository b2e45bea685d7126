// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walks.h"

#include <cellwalk/internal/io/csv.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

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
/// Motions in one copy of a mesh, which makes its oracle anew.
constexpr std::uint64_t motions_per_mesh = 2500;

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

/// Walks motions in a scene by each kernel.
/// \param next makes a motion
template <int D, class Next>
Counts walk_in(const Scene<D>& scene, std::uint64_t motions, const std::bitset<kernel_count>& walking,
               Random& random, const Next& next) {
  const auto tested = kernels<D>();
  Counts counts;
  while (counts.motions < motions) {
    const Motion<D> way = next();
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

/// Walks `count` motions in worlds of so many motions each.
/// \param walk (seed, motions) counts in a world
template <class Walk>
Counts walk_in_worlds(const std::string& name, std::uint64_t per_world, const Run_options& options,
                      const Walk& walk) {
  return options.kept->of<Counts>(name, [&] {
    const std::uint64_t worlds = (options.count + per_world - 1) / per_world;
    const auto counts = experiments::shared_trials(worlds, [&](std::uint64_t w) {
      return walk(experiments::part_seed(options.seed, name, w),
                  std::min(per_world, options.count - w * per_world));
    });
    Counts sum;
    for (const Counts& c : counts) sum += c;
    return sum;
  });
}

template <int D>
Counts walk_at(const Grid_point& point, const Run_options& options) {
  return walk_in_worlds(fmt::format("walks {} {} {}", D, point.variable, point.value), motions_per_world,
                        options, [&](std::uint64_t seed, std::uint64_t motions) {
                          Random random(seed);
                          const Scene<D> scene(make_world<D>(point.setting, seed));
                          return walk_in(scene, motions, options.kernels, random,
                                         [&] { return make_motion(scene.world, point.setting, random); });
                        });
}

Counts walk_in_mesh(const std::filesystem::path& file, const Run_options& options) {
  const Mesh_world mesh = read_mesh_world(file);
  return walk_in_worlds(fmt::format("walks 3 mesh {}", file.filename().string()), motions_per_mesh, options,
                        [&](std::uint64_t seed, std::uint64_t motions) {
                          Random random(seed);
                          World<3> world;
                          world.soup = mesh.soup;
                          const Scene<3> scene(std::move(world));
                          return walk_in(scene, motions, options.kernels, random,
                                         [&] { return make_motion(mesh, random); });
                        });
}

/// The rows of one value of a variable.
struct Walk_table {
  io::Csv_writer csv;
  Exact_summary summary{};

  template <class Value>
  void add(int dimension, const std::string& variable, const Value& value, const Counts& counts,
           const std::bitset<kernel_count>& walking) {
    const auto tested = kernels<3>();
    summary.motions += counts.motions;
    fmt::print("walks {}D {} {}: {} motions", dimension, variable, value, counts.motions);
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!walking[k]) continue;
      const Tally& t = counts.tallies[k];
      const auto interval = experiments::confidence_interval(wrong(t), total(t));
      csv.row(dimension, variable, value, tested[k].name, counts.motions, counts.degenerate, counts.blocked,
              wrong(t), interval.low, interval.high, t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9],
              t[10]);
      fmt::print(", {} {} wrong", tested[k].name, wrong(t));
      if (!tested[k].is_exact) continue;
      summary.by_exact += total(t);
      summary.wrong += wrong(t);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
};

}  // namespace

Exact_summary run_walks(const Run_options& options) {
  std::vector<std::string> columns{"dimension",  "variable", "value", "kernel", "motions",
                                   "degenerate", "blocked",  "wrong", "low",    "high"};
  columns.insert(columns.end(), outcome_names.begin() + 1, outcome_names.end());
  Walk_table table{{options.folder / "walks.csv", columns}};
  for (const Grid_point& point : all_points())
    table.add(2, point.variable, point.value, walk_at<2>(point, options), options.kernels);
  for (const Grid_point& point : all_points())
    table.add(3, point.variable, point.value, walk_at<3>(point, options), options.kernels);
  for (const auto& file : options.meshes)
    table.add(3, "mesh", file.filename().string(), walk_in_mesh(file, options), options.kernels);
  table.csv.commit();
  return table.summary;
}

}  // namespace cellwalk::exact_float
