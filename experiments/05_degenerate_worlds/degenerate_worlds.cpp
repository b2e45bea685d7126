// SPDX-License-Identifier: LGPL-3.0-or-later
// Degenerate motions in degenerate worlds under every kernel of `cellwalk query`, judged by the oracle; and
// the two touch policies.
//
//   degenerate_worlds -o DIR [--motions N] [--seed S] [--threads N] [--commit NAME]
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "02_exact_versus_float/kernels.h"
#include "02_exact_versus_float/scene.h"
#include "02_exact_versus_float/tally.h"
#include "common/confidence.h"
#include "common/manifest.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "kinds.h"

namespace cellwalk::degenerate_worlds {
namespace {

using exact_float::add;
using exact_float::kernel_count;
using exact_float::Tally;
using exact_float::total;
using exact_float::wrong;

constexpr std::uint64_t motions_per_world = 50;

struct Counts {
  std::uint64_t motions = 0, blocked = 0, either = 0;
  std::uint64_t stops = 0;          ///< contacts with Touch::stop
  std::uint64_t wrong_touches = 0;  ///< answers with Touch::stop that are not those of the oracle
  std::array<Tally, kernel_count> tallies{};

  void operator+=(const Counts& other) {
    motions += other.motions;
    blocked += other.blocked;
    either += other.either;
    stops += other.stops;
    wrong_touches += other.wrong_touches;
    for (std::size_t k = 0; k < kernel_count; ++k) add(tallies[k], other.tallies[k]);
  }
};

/// One kind of world and motion.
struct Family {
  World_kind world;
  bool is_turned;
  std::size_t motion;  ///< of motion_families
};

std::vector<Family> all_families() {
  std::vector<Family> families;
  for (std::size_t w = 0; w < world_names.size(); ++w)
    for (const bool is_turned : {false, true})
      for (std::size_t m = 0; m < motion_families.size(); ++m)
        families.push_back({static_cast<World_kind>(w), is_turned, m});
  return families;
}

std::string name(const Family& f) {
  return fmt::format("{} {} {}", world_names[static_cast<std::size_t>(f.world)], placement_names[f.is_turned],
                     motion_families[f.motion].first);
}

/// True if a wall meets the motion off its start.
/// \pre the motion arrives
bool touches(const oracle::Trace& trace) {
  return std::any_of(trace.incidences.begin(), trace.incidences.end(),
                     [](const oracle::Incidence& i) { return !i.passable && i.last > 0; });
}

template <int D>
Counts walk_in_world(const Family& family, std::uint64_t seed, std::uint64_t motions) {
  exact_float::World<D> world;
  world.soup = make_soup<D>(family.world, family.is_turned, seed);
  const oracle::World<D> source_world{"", world.soup, true};
  oracle::Motion_source<D> source(source_world, seed);
  const exact_float::Scene<D> scene(std::move(world));
  const auto kernels = exact_float::kernels<D>();
  const oracle::Motion_kind kind = motion_families[family.motion].second;
  Counts counts;
  while (counts.motions < motions) {
    const auto particle = scene.particle_at(source.start(kind), source.random());
    if (!particle) continue;
    const Point<D> to = source.target(kind, particle->position, particle->position);
    const oracle::Case<D> motion = scene.motion_of(*particle, to);
    ++counts.motions;
    const bool is_blocked = motion.truth.arrivals.empty(), is_free = motion.truth.stops.empty();
    counts.blocked += is_blocked;
    counts.either += !is_blocked && !is_free;
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!kernels[k].policy) continue;
      std::vector<Cell> visited;
      Walk_counts ignored;
      const auto result =
          kernels[k].walk(scene.snapshot, *particle, to, ignored, kernels[k].strategy, {&visited});
      const auto outcome = exact_float::outcome_of(scene.oracle, scene.snapshot, motion, result, visited);
      ++counts.tallies[k][static_cast<std::size_t>(outcome)];
    }
    Edge_counts ignored;
    const bool stops = first_touch(scene.snapshot, *particle, to, ignored).has_value();
    counts.stops += stops;
    if (is_blocked || is_free) counts.wrong_touches += stops != (is_blocked || touches(motion.trace));
  }
  return counts;
}

template <int D>
Counts walk_family(const Family& family, std::uint64_t seed, std::uint64_t motions) {
  const std::uint64_t worlds = (motions + motions_per_world - 1) / motions_per_world;
  const auto counts = experiments::shared_trials(worlds, [&](std::uint64_t w) {
    return walk_in_world<D>(family,
                            experiments::part_seed(seed, fmt::format("degenerate {} {}", D, name(family)), w),
                            std::min(motions_per_world, motions - w * motions_per_world));
  });
  Counts sum;
  for (const Counts& c : counts) sum += c;
  return sum;
}

struct Tables {
  io::Csv_writer walks, touches;
  std::uint64_t motions = 0, by_exact = 0, wrong = 0, wrong_touches = 0;
};

template <int D>
void run_dimension(std::uint64_t seed, std::uint64_t motions, Tables& tables) {
  const auto kernels = exact_float::kernels<D>();
  for (const Family& family : all_families()) {
    const Counts counts = walk_family<D>(family, seed, motions);
    const char* world = world_names[static_cast<std::size_t>(family.world)];
    const char* placement = placement_names[family.is_turned];
    const char* motion = motion_families[family.motion].first;
    tables.motions += counts.motions;
    tables.wrong_touches += counts.wrong_touches;
    tables.touches.row(D, world, placement, motion, counts.motions, counts.blocked, counts.either,
                       counts.stops, counts.wrong_touches);
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!kernels[k].policy) continue;
      const Tally& t = counts.tallies[k];
      const auto interval = experiments::confidence_interval(wrong(t), total(t));
      tables.walks.row(D, world, placement, motion, kernels[k].name, counts.motions, counts.blocked, wrong(t),
                       interval.low, interval.high, t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9],
                       t[10]);
      if (!kernels[k].is_exact) continue;
      tables.by_exact += total(t);
      tables.wrong += wrong(t);
    }
  }
}

/// Returns how often the exact kernels, or the touch policy, were wrong.
std::uint64_t run(const std::filesystem::path& folder, std::uint64_t seed, std::uint64_t motions,
                  const std::string& commit) {
  std::vector<std::string> columns{"dimension", "world",   "placement", "motion", "kernel",
                                   "motions",   "blocked", "wrong",     "low",    "high"};
  columns.insert(columns.end(), exact_float::outcome_names.begin() + 1, exact_float::outcome_names.end());
  Tables tables{{folder / "degenerate.csv", columns},
                {folder / "touches.csv",
                 {"dimension", "world", "placement", "motion", "motions", "blocked", "either",
                  "contacts_with_stop", "wrong_with_stop"}}};
  run_dimension<2>(seed, motions, tables);
  run_dimension<3>(seed, motions, tables);
  tables.walks.commit();
  tables.touches.commit();
  nlohmann::ordered_json manifest = experiments::manifest(commit);
  manifest["seed"] = seed;
  manifest["exact"] = {{"motions", tables.motions},
                       {"by_exact_kernels", tables.by_exact},
                       {"wrong", tables.wrong},
                       {"wrong_with_stop", tables.wrong_touches}};
  io::write_json(folder / "manifest.json", manifest);
  fmt::print("{} motions judged, {} walks of exact kernels, {} of them wrong; with touch stop {} wrong\n",
             tables.motions, tables.by_exact, tables.wrong, tables.wrong_touches);
  return tables.wrong + tables.wrong_touches;
}

}  // namespace
}  // namespace cellwalk::degenerate_worlds

int main(int argc, char** argv) {
  cellwalk::experiments::silence_later_ranks();
  CLI::App app("Walks degenerate motions in degenerate worlds by exact and rounded kernels");
  std::string folder, commit = "unknown";
  std::uint64_t seed = 1, motions = 100;
  std::size_t threads = 1;
  app.add_option("-o,--out", folder, "folder for the tables and manifest.json")->required();
  app.add_option("--motions", motions, "of each family in each kind of world")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of everything");
  app.add_option("--threads", threads, "tables do not depend on it")->check(CLI::Range(1, 1024));
  app.add_option("--commit", commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return cellwalk::experiments::run_on_ranks("degenerate_worlds", folder, [&](const auto& of_rank) {
    return cellwalk::degenerate_worlds::run(of_rank, seed, motions, commit) == 0 ? 0 : 1;
  });
}
