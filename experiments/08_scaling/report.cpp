// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/manifest.h"
#include "common/processor_time.h"
#include "handovers.h"
#include "scenes.h"

namespace cellwalk::scaling {
namespace {

constexpr std::uint32_t most_ranks = 1024;
constexpr std::size_t least_cells = 16;  // of a rank

std::vector<Counter> counters(const Snapshot<3>& snapshot, bool quick) {
  std::vector<Counter> all;
  for (std::uint32_t ranks = 2; ranks <= (quick ? 8 : most_ranks); ranks *= 2)
    if (snapshot.cell_count() >= least_cells * ranks) all.emplace_back(snapshot, ranks);
  return all;
}

/// Seconds of the steps alone, in this thread.
double follow(Running_scene& scene, std::uint32_t steps, std::vector<Counter>& counters) {
  double seconds = 0;
  for (std::uint32_t step = 0; step <= steps; ++step) {
    if (step > 0) {
      const double start = experiments::processor_seconds();
      scene.world().step();
      seconds += experiments::processor_seconds() - start;
    }
    scene.world().validate();  // chains are those of where bodies are
    for (Counter& counter : counters) counter.count(scene.world());
  }
  return seconds;
}

}  // namespace

void run(const experiments::Plan& plan, const std::filesystem::path& folder) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(plan.threads));
  io::Csv_writer handovers(folder / "handovers.csv",
                           {"scene", "ranks", "steps", "vertices", "moved", "edges", "parted", "crossings",
                            "bodies", "parted_bodies", "most_vertices", "most_received", "longest"});
  io::Csv_writer parts(folder / "parts.csv", {"scene", "ranks", "cells", "ghosts", "most_neighbours"});
  std::vector<std::pair<std::string, double>> timings;
  for (const Scene_entry& entry : all_scenes(plan.quick)) {
    Running_scene scene(entry);
    std::vector<Counter> all = counters(scene.snapshot(), plan.quick);
    const double seconds = follow(scene, entry.steps, all);
    const std::uint64_t vertices = all.front().sum().vertices;
    // The state before the first step is counted, too.
    timings.emplace_back(entry.name,
                         1e6 * seconds * (entry.steps + 1) / entry.steps / static_cast<double>(vertices));
    for (const Counter& counter : all) {
      const Handovers& s = counter.sum();
      const Ranges& r = counter.ranges();
      handovers.row(entry.name, r.ranks(), entry.steps, s.vertices, s.moved, s.edges, s.parted, s.crossings,
                    s.bodies, s.parted_bodies, s.most_vertices, s.most_received, s.longest);
      parts.row(entry.name, r.ranks(), scene.snapshot().cell_count(), r.ghosts(), r.most_neighbours());
    }
    fmt::print("{}: {} cells, {} vertices in {} steps\n", entry.name, scene.snapshot().cell_count(),
               vertices / (entry.steps + 1), entry.steps);
  }
  handovers.commit();
  parts.commit();
  if (plan.rounds > 0) {
    io::Csv_writer table(folder / "timings.csv", {"scene", "us_per_vertex"});
    for (const auto& [name, us] : timings) table.row(name, us);
    table.commit();
  }
  io::write_json(folder / "manifest.json", experiments::manifest(plan.commit));
}

}  // namespace cellwalk::scaling
