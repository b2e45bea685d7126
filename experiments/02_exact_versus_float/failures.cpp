// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failures.h"

#include <fmt/format.h>

#include <set>
#include <string>

#include "common/seeds.h"
#include "tally.h"

namespace cellwalk::exact_float {
namespace {

constexpr std::uint64_t motions_per_world = 100;

template <int D>
class Failure_search {
 public:
  explicit Failure_search(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void search_world(std::uint64_t seed) {
    const Setting setting{.on_degeneracy = true};
    Random random(seed);
    const Scene<D> scene(make_world<D>(setting, seed));
    for (std::uint64_t k = 0; k < motions_per_world; ++k) {
      const Motion<D> way = make_motion(scene.world, setting, random);
      const auto particle = scene.particle_at(way.from, random);
      if (!particle) continue;
      const oracle::Case<D> motion = scene.motion_of(*particle, way.to);
      for (const Kernel<D>& kernel : kernels_)
        if (!kernel.is_exact) walk(scene, kernel, *particle, motion);
    }
  }

  std::uint64_t count() const { return found_.size(); }

 private:
  void walk(const Scene<D>& scene, const Kernel<D>& kernel, const Particle<D>& particle,
            const oracle::Case<D>& motion) {
    std::vector<Cell> visited;
    Walk_counts counts;
    const Walk_result<D> result =
        kernel.walk(scene.snapshot, particle, motion.to, counts, {kernel.strategy, &visited, nullptr});
    const Outcome outcome = outcome_of(scene.oracle, scene.snapshot, motion, result, visited);
    if (outcome == Outcome::right) return;
    const char* what = outcome_names[static_cast<std::size_t>(outcome)];
    const std::string name = fmt::format("{}d_{}_{}", D, kernel.name, what);
    if (!found_.insert(name).second) return;
    write_failure(folder_ / (name + ".json"), scene, kernel, particle, motion.to,
                  fmt::format("{} walk, judged by the oracle: {}", kernel.name, what));
  }

  const std::filesystem::path folder_;
  const std::array<Kernel<D>, kernel_count> kernels_ = kernels<D>();
  std::set<std::string> found_;
};

template <int D>
std::uint64_t search(const Run_options& options) {
  Failure_search<D> failures(options.folder / "failures");
  for (std::uint64_t w = 0; w * motions_per_world < options.count; ++w)
    failures.search_world(experiments::part_seed(options.seed, fmt::format("failures {}", D), w));
  return failures.count();
}

}  // namespace

std::uint64_t run_failures(const Run_options& options) {
  std::filesystem::create_directories(options.folder / "failures");
  const std::uint64_t count = search<2>(options) + search<3>(options);
  fmt::print("failures: {} records\n", count);
  return count;
}

}  // namespace cellwalk::exact_float
