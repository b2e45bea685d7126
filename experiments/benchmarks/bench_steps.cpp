// SPDX-License-Identifier: LGPL-3.0-or-later
// How long the steps of a scene take, up to the longest: a catheter that slides through a vessel,
// its elastic rod, the complete sweep of its edges, contacts and verified stops included.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/io/scene.h>
#include <cellwalk/simulation/world.h>

#include <benchmark/benchmark.h>

#include <string>
#include <variant>
#include <vector>

#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace {

using namespace cellwalk;

const Environment<3>& vessel() {
  static const Environment<3> environment = Environment<3>::build(branching_vessel({}));
  return environment;
}

void steps_of_catheter(benchmark::State& state, const std::vector<std::string>& changes) {
  const std::string file = CELLWALK_DATA "/catheter.json";
  const auto scene =
      std::get<Scene<3>>(io::parse_scene(file, io::change_scene(file, io::scene_text(file), changes)));
  std::vector<double> microseconds;
  std::uint64_t contacts = 0;
  for (auto _ : state) {
    state.PauseTiming();
    World<3> world(vessel().snapshot(), scene);
    state.ResumeTiming();
    for (std::uint32_t i = 0; i < scene.steps; ++i) {
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

BENCHMARK_CAPTURE(steps_of_catheter, vertices_110, {})->Unit(benchmark::kMillisecond)->MinTime(2);
BENCHMARK_CAPTURE(steps_of_catheter, vertices_200, {"catheter.particles=200", "catheter.spacing=0.11"})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2);

}  // namespace
