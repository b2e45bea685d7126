// SPDX-License-Identifier: LGPL-3.0-or-later
// How long the steps of a scene take, up to the longest: a catheter that slides through a vessel, a vessel
// that beats, or an aneurysm, its elastic rod, the complete sweep of its edges, contacts and verified stops
// included.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/internal/simulation/wall_pulsation.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/loading/environment_file.h>

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace {

using namespace cellwalk;

Scene<3> scene_of(const std::string& file, const std::vector<std::string>& changes) {
  return std::get<Scene<3>>(io::parse_scene(file, io::change_scene(file, io::scene_text(file), changes)));
}

/// Runs a scene again and again. Walls move between the steps, which is not timed.
/// \param make_environment called for each run if walls move
template <class Make_environment>
void run_steps(benchmark::State& state, const Scene<3>& scene, const Make_environment& make_environment) {
  std::vector<double> microseconds;
  std::uint64_t contacts = 0;
  std::optional<Environment<3>> environment;
  for (auto _ : state) {
    state.PauseTiming();
    const bool moves_walls = scene.walls && scene.walls->pulsation;
    if (!environment || moves_walls) environment.emplace(make_environment());
    World<3> world(environment->snapshot(), scene);
    std::optional<Wall_pulsation<3>> walls;
    if (moves_walls) walls.emplace(environment->snapshot(), *scene.walls->pulsation, scene.walls->fixed);
    Reshape_counts counts;
    state.ResumeTiming();
    for (std::uint32_t i = 1; i <= scene.steps; ++i) {
      if (walls) world.move_walls(*environment, walls->targets(i * scene.time_step), {}, counts);
      const double before = experiments::processor_seconds();
      world.step();
      microseconds.push_back(1e6 * (experiments::processor_seconds() - before));
    }
    contacts = world.body_counts().contacts;
  }
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["us_median"] = experiments::median(microseconds);
  state.counters["us_99"] = experiments::quantile(microseconds, 0.99);
  state.counters["us_99.9"] = experiments::quantile(microseconds, 0.999);
  state.counters["us_most"] = experiments::quantile(microseconds, 1);
}

void steps_in_vessel(benchmark::State& state, const char* file, const std::vector<std::string>& changes) {
  run_steps(state, scene_of(std::string(CELLWALK_DATA) + "/" + file, changes),
            [] { return Environment<3>::build(branching_vessel({})); });
}

/// The catheter that is pressed into the bends of an aneurysm, of experiment 06.
void steps_in_aneurysm(benchmark::State& state) {
  const char* folder = std::getenv("CELLWALK_REAL_SCENES");
  if (folder == nullptr)
    return state.SkipWithError("CELLWALK_REAL_SCENES does not name the scenes of experiment 06");
  const std::string path = folder;
  run_steps(state, scene_of(path + "/R2_pressed_aneurysm.json", {}), [&] {
    return std::get<Environment<3>>(load_environment(path + "/aneurysm.ovm", {}).environment);
  });
}

BENCHMARK_CAPTURE(steps_in_vessel, vertices_110, "catheter.json", {"catheter.radius=0"})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);
BENCHMARK_CAPTURE(steps_in_vessel, vertices_200, "catheter.json",
                  {"catheter.particles=200", "catheter.spacing=0.11", "catheter.radius=0"})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);
BENCHMARK_CAPTURE(steps_in_vessel, beating_vertices_200, "pulse.json",
                  {"catheter.particles=200", "catheter.spacing=0.11", "particles=[]"})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(4);
BENCHMARK(steps_in_aneurysm)->Unit(benchmark::kMillisecond)->MinTime(2);

}  // namespace
