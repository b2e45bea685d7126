// SPDX-License-Identifier: LGPL-3.0-or-later
#include "times.h"

#include <cellwalk/internal/io/csv.h>

#include <fmt/format.h>
#include <gmp.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <new>
#include <vector>

#include "common/seeds.h"
#include "kernels.h"
#include "scene.h"

namespace {

thread_local std::size_t allocated = 0;  ///< bytes asked for so far by this thread

void* count_and_allocate(std::size_t size) {
  allocated += size;
  return std::malloc(size);
}
void* count_and_reallocate(void* p, std::size_t old_size, std::size_t size) {
  allocated += size > old_size ? size - old_size : 0;
  return std::realloc(p, size);
}

}  // namespace

namespace cellwalk::exact_float {
namespace {

constexpr int rounds = 5;
constexpr std::uint64_t motions_per_world = 250;

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::array<double, rounds> values) {
  std::sort(values.begin(), values.end());
  return values[rounds / 2];
}

template <int D>
struct Batch {
  explicit Batch(World<D> world) : scene(std::move(world)) {}
  Scene<D> scene;
  std::vector<std::pair<Particle<D>, Point<D>>> motions;
};

template <int D>
std::deque<Batch<D>> make_batches(bool is_degenerate, bool is_blocked, const Run_options& options) {
  Setting setting;
  if (is_degenerate)
    setting.on_degeneracy = true;
  else
    setting.ulps = 40;
  std::deque<Batch<D>> batches;
  for (std::uint64_t w = 0; w * motions_per_world < options.count; ++w) {
    const std::uint64_t seed = experiments::part_seed(options.seed, fmt::format("times {}", D), w);
    Random random(seed);
    Batch<D>& batch = batches.emplace_back(make_world<D>(setting, seed));
    while (batch.motions.size() < motions_per_world) {
      const Motion<D> way = make_motion(batch.scene.world, setting, random);
      const auto particle = batch.scene.particle_at(way.from, random);
      if (particle && batch.scene.motion_of(*particle, way.to).truth.arrivals.empty() == is_blocked)
        batch.motions.emplace_back(*particle, way.to);
    }
  }
  return batches;
}

template <int D>
void time_dimension(const Run_options& options, io::Csv_writer& table) {
  for (const int set : {0, 1, 2, 3}) {
    const bool is_degenerate = set / 2 == 1, is_blocked = set % 2 == 1;
    const auto batches = make_batches<D>(is_degenerate, is_blocked, options);
    for (const Kernel<D>& kernel : kernels<D>()) {
      Walk_counts counts;
      std::array<double, rounds> seconds;
      std::size_t bytes = 0;
      for (double& s : seconds) {
        counts = {};
        const std::size_t before = allocated;
        const double begin = processor_seconds();
        for (const Batch<D>& batch : batches)
          for (const auto& [particle, to] : batch.motions)
            kernel.walk(batch.scene.snapshot, particle, to, counts, kernel.strategy, {});
        s = processor_seconds() - begin;
        bytes = allocated - before;
      }
      const auto walks = static_cast<double>(counts.walks);
      const double ns = 1e9 * median(seconds) / walks;
      table.row(D, is_degenerate ? "degenerate" : "displaced", is_blocked ? "blocked" : "free", kernel.name,
                counts.walks, ns, static_cast<double>(bytes) / walks,
                static_cast<double>(counts.crossings) / walks,
                static_cast<double>(counts.predicates.orientations) / walks,
                static_cast<double>(counts.predicates.fallbacks) / walks);
      fmt::print("times {}D {} {} {}: {:.0f} ns, {:.0f} bytes a walk\n", D,
                 is_degenerate ? "degenerate" : "displaced", is_blocked ? "blocked" : "free", kernel.name, ns,
                 static_cast<double>(bytes) / walks);
    }
  }
}

}  // namespace

void run_times(const Run_options& options) {
  void* (*old_allocate)(std::size_t) = nullptr;
  void* (*old_reallocate)(void*, std::size_t, std::size_t) = nullptr;
  void (*old_free)(void*, std::size_t) = nullptr;
  mp_get_memory_functions(&old_allocate, &old_reallocate, &old_free);
  mp_set_memory_functions(count_and_allocate, count_and_reallocate, old_free);
  io::Csv_writer table(options.folder / "times.csv",
                       {"dimension", "motions", "end", "kernel", "walks", "ns_per_walk", "bytes_per_walk",
                        "crossings_per_walk", "signs_per_walk", "fallbacks_per_walk"});
  time_dimension<2>(options, table);
  time_dimension<3>(options, table);
  table.commit();
  mp_set_memory_functions(old_allocate, old_reallocate, old_free);
}

}  // namespace cellwalk::exact_float

// The program's own allocations, counted. GMP has its own, above.
void* operator new(std::size_t size) {
  if (void* p = count_and_allocate(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
