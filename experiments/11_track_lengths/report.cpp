// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"
#include "common/manifest.h"
#include "common/order_statistics.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "times.h"

namespace cellwalk::track_lengths {
namespace {

using experiments::part_seed;
using experiments::Plan;
namespace fs = std::filesystem;

/// How much is done; rays of each kind in each world.
struct Amount {
  std::size_t tetrahedra, rays, rays_of_part, judged_of_part, rays_on_threads, rays_of_peers;
  int most_threads;
  std::size_t many_tetrahedra, timed_rays, timed_rays_in_many;  // of what is timed
};
constexpr Amount full{10'000, 1'250'000, 10'000, 125, 50'000, 50'000, 8, 1'000'000, 4'000, 40'000};
constexpr Amount quick{6'000, 2'000, 500, 100, 2'000, 1'000, 2, 20'000, 500, 500};

std::vector<std::unique_ptr<World>> worlds(const Plan& plan, const Amount& amount, const fs::path& mesh) {
  std::vector<std::unique_ptr<World>> all;
  all.push_back(jittered_grid(amount.tetrahedra, part_seed(plan.seed, "grid")));
  all.push_back(random_points(amount.tetrahedra, part_seed(plan.seed, "random points")));
  all.push_back(lattice(amount.tetrahedra));
  if (!mesh.empty()) all.push_back(mesh_file(mesh));
  return all;
}

Part part_of(const Plan& plan, const Amount& amount, const World& world, Ray_kind kind, std::size_t number) {
  return {kind, amount.rays_of_part, amount.judged_of_part,
          part_seed(part_seed(plan.seed, world.name), name_of(kind), number)};
}

/// The results of parts, made by so many threads, in order.
template <class Make>
auto of_parts(int threads, std::size_t parts, const Make& make) {
  using Result = decltype(make(std::size_t{0}));
  std::vector<Result> results(parts);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) { results[i] = make(i); }); });
  return results;
}

class Check_tables {
 public:
  explicit Check_tables(const fs::path& folder)
      : checks_(folder / "checks.csv", {"world", "rays", "count", "pieces", "crossings", "blocked", "empty",
                                        "broken", "judged", "judged_pieces", "wrong", "divided", "digest"}),
        costs_(folder / "costs.csv",
               {"world", "rays", "count", "signs", "exact_fallbacks", "judged", "without_signs"}),
        threads_(folder / "threads.csv", {"world", "rays", "threads", "count", "digest"}) {}

  void check_all(const Plan& plan, const Amount& amount, const World& world) {
    const Tracer<3> tracer(world.snapshot());
    const Judge judge(world.snapshot());
    for (const Ray_kind kind : ray_kinds) {
      Check_counts sum;
      for (const Check_counts& part :
           of_parts(plan.threads, amount.rays / amount.rays_of_part, [&](std::size_t i) {
             return check(world, tracer, judge, part_of(plan, amount, world, kind, i));
           }))
        sum += part;
      fmt::print("{}, {}: {} rays, {} pieces\n", world.name, name_of(kind), sum.rays, sum.pieces);
      std::fflush(stdout);
      checks_.row(world.name, name_of(kind), sum.rays, sum.pieces, sum.crossings, sum.blocked, sum.empty,
                  sum.broken, sum.judged, sum.judged_pieces, sum.wrong, sum.divided,
                  fmt::format("{:016x}", sum.digest));
      costs_.row(world.name, name_of(kind), sum.rays, sum.signs, sum.fallbacks, sum.judged,
                 sum.without_signs);
      bad_ += sum.broken + sum.wrong + sum.divided;
      compare_threads(plan, amount, world, tracer, kind);
    }
  }

  void commit() {
    checks_.commit();
    costs_.commit();
    threads_.commit();
    if (bad_ > 0)
      throw std::runtime_error(fmt::format("{} rows are wrong: see checks.csv and threads.csv", bad_));
  }

 private:
  void compare_threads(const Plan& plan, const Amount& amount, const World& world, const Tracer<3>& tracer,
                       Ray_kind kind) {
    std::uint64_t of_one = 0;
    for (int threads = 1; threads <= amount.most_threads; ++threads) {
      std::uint64_t all = 0;
      const std::size_t parts = amount.rays_on_threads / amount.rays_of_part;
      for (const std::uint64_t part : of_parts(threads, parts, [&](std::size_t i) {
             return digest(world, tracer, part_of(plan, amount, world, kind, i));
           }))
        all = scramble(all ^ part);
      if (threads == 1) of_one = all;
      bad_ += all != of_one;
      threads_.row(world.name, name_of(kind), threads, amount.rays_on_threads, fmt::format("{:016x}", all));
    }
  }

  io::Csv_writer checks_, costs_, threads_;
  std::uint64_t bad_ = 0;
};

void count_failures(const Plan& plan, const Amount& amount, const World& world, io::Csv_writer& table) {
  for (const Ray_kind kind : ray_kinds) {
    const Rays rays = draw(world, kind, amount.rays_of_peers, part_seed(plan.seed, "peers"));
    for (const Method_result& method : compare(world, rays, 0, false).methods) {
      const Failures& f = method.failures;
      if (method.is_peer)
        table.row(world.name, name_of(kind), method.method, f.rays, f.endless, f.lost, f.wrong_cells,
                  f.wrong_sums, f.compared, f.not_nearest, fmt::format("{:.3g}", f.greatest_error));
    }
  }
}

/// Times; a row for each method.
void time(const Plan& plan, const World& world, Ray_kind kind, std::size_t count, bool in_cache,
          io::Csv_writer& table) {
  const Rays rays = draw(world, kind, count, part_seed(plan.seed, "times"));
  const Comparison comparison = compare(world, rays, plan.rounds, in_cache);
  const auto crossings = static_cast<double>(comparison.crossings);
  const double of_trace = experiments::median(comparison.methods.front().seconds);
  for (const Method_result& method : comparison.methods) {
    const double seconds = experiments::median(method.seconds);
    table.row(world.name, world.snapshot().cell_count(), name_of(kind), rays.size(), comparison.crossings,
              method.method, fmt::format("{:.2f}", 1e9 * seconds / crossings),
              fmt::format("{:.3f}", seconds / of_trace));
  }
  fmt::print("{}, {} cells, {}: timed\n", world.name, world.snapshot().cell_count(), name_of(kind));
  std::fflush(stdout);
}

}  // namespace

void run(const Plan& plan, const fs::path& mesh, const fs::path& folder) {
  if (experiments::is_idle(true)) return;
  const Amount& amount = plan.quick ? quick : full;
  Check_tables checks(folder);
  io::Csv_writer failed(folder / "failures.csv",
                        {"world", "rays", "peer", "count", "endless", "lost", "wrong_cells", "wrong_sums",
                         "compared", "not_nearest", "greatest_error"});
  const bool is_timed = plan.rounds > 0;
  std::optional<io::Csv_writer> times;
  if (is_timed)
    times.emplace(folder / "times.csv",
                  std::vector<std::string>{"world", "cells", "rays", "count", "crossings", "method",
                                           "ns_per_crossing", "of_trace"});
  for (const auto& world : worlds(plan, amount, mesh)) {
    checks.check_all(plan, amount, *world);
    count_failures(plan, amount, *world, failed);
    if (is_timed)
      for (const Ray_kind kind : ray_kinds) time(plan, *world, kind, amount.timed_rays, true, *times);
  }
  if (is_timed) {
    const auto many = random_points(amount.many_tetrahedra, part_seed(plan.seed, "many points"));
    for (const Ray_kind kind : ray_kinds) time(plan, *many, kind, amount.timed_rays_in_many, false, *times);
    times->commit();
  }
  failed.commit();
  nlohmann::ordered_json manifest = experiments::manifest(plan.commit);
  manifest["seed"] = plan.seed;
  io::write_json(folder / "manifest.json", manifest);
  checks.commit();
}

}  // namespace cellwalk::track_lengths
