// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failures.h"

#include <cellwalk/internal/io/atomic_file.h>

#include <fmt/format.h>

#include <map>
#include <string>

#include "common/seeds.h"
#include "common/shared.h"
#include "tally.h"

namespace cellwalk::exact_float {
namespace {

constexpr std::uint64_t motions_per_world = 100;

template <int D>
class Failure_search {
 public:
  explicit Failure_search(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// \param number of the world
  void search_world(std::uint64_t number, std::uint64_t seed) {
    number_ = number;
    const Setting setting{.on_degeneracy = true};
    Random random(seed);
    const Scene<D> scene(make_world<D>(setting, seed));
    for (std::uint64_t k = 0; k < motions_per_world; ++k) {
      const Motion<D> way = make_motion(scene.world, setting, random);
      const auto particle = scene.particle_at(way.from, random);
      if (!particle) continue;
      const oracle::Case<D> motion = scene.motion_of(*particle, way.to);
      for (const Kernel<D>& kernel : kernels_)
        if (!kernel.is_exact && kernel.policy) walk(scene, kernel, *particle, motion);
    }
  }

  /// Leaves the record of each name that is of the lowest world, of all ranks, to the first.
  std::uint64_t gather() {
    experiments::Result_writer own;
    own(found_.size());
    for (const auto& [name, world] : found_) {
      own(name);
      own(world);
      own(experiments::text_of(folder_ / name));
    }
    experiments::ranks().gather(own.message(), [this](const std::string& bytes) {
      experiments::Result_reader reader(bytes);
      std::size_t left = 0;
      for (reader(left); left > 0; --left) {
        std::string name, text;
        std::uint64_t world = 0;
        reader(name);
        reader(world);
        reader(text);
        const auto [at, is_new] = found_.try_emplace(name, world);
        if (!is_new && at->second <= world) continue;
        at->second = world;
        io::write_file(folder_ / name, text);
      }
    });
    return found_.size();
  }

 private:
  void walk(const Scene<D>& scene, const Kernel<D>& kernel, const Particle<D>& particle,
            const oracle::Case<D>& motion) {
    std::vector<Cell> visited;
    Walk_counts counts;
    const Walk_result<D> result =
        kernel.walk(scene.snapshot, particle, motion.to, counts, kernel.strategy, {&visited});
    const Outcome outcome = outcome_of(scene.oracle, scene.snapshot, motion, result, visited);
    if (outcome == Outcome::right) return;
    const char* what = outcome_names[static_cast<std::size_t>(outcome)];
    const std::string name = fmt::format("{}d_{}_{}.json", D, kernel.name, what);
    if (!found_.try_emplace(name, number_).second) return;
    write_failure(folder_ / name, scene, kernel, particle, motion.to,
                  fmt::format("{} walk, judged by the oracle: {}", kernel.name, what));
  }

  const std::filesystem::path folder_;
  const std::array<Kernel<D>, kernel_count> kernels_ = kernels<D>();
  std::uint64_t number_ = 0;                    ///< of the world
  std::map<std::string, std::uint64_t> found_;  ///< files, with the worlds of their motions
};

template <int D>
std::uint64_t search(const Run_options& options) {
  Failure_search<D> failures(options.folder / "failures");
  const Ranks& ranks = experiments::ranks();
  for (std::uint64_t w = ranks.rank(); w * motions_per_world < options.count; w += ranks.size())
    failures.search_world(w, experiments::part_seed(options.seed, fmt::format("failures {}", D), w));
  return failures.gather();
}

}  // namespace

std::uint64_t run_failures(const Run_options& options) {
  std::filesystem::create_directories(options.folder / "failures");
  const std::uint64_t count = search<2>(options) + search<3>(options);
  fmt::print("failures: {} records\n", count);
  return count;
}

}  // namespace cellwalk::exact_float
