// SPDX-License-Identifier: LGPL-3.0-or-later
// What a second thread brings to many bodies: the scene of data/hexahedra.json, without files: 225
// hexahedra bounce in a grid of 10^3 hexahedral cells, a tenth of them solid. The last argument is the
// number of threads; time is that of the clock.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>
#include <cellwalk/internal/simulation/world.h>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace {

using namespace cellwalk;

Snapshot<3> compile(const Grid_options<3>& options) {
  const Cell_soup<3> soup = hex_grid(options);
  return Snapshot<3>::compile(soup, glue(soup));
}

const Snapshot<3>& grid() {
  static const Snapshot<3> snapshot = [] {
    Grid_options<3> options;
    options.cells = {10, 10, 10};
    options.solid_share = 0.1;
    return compile(options);
  }();
  return snapshot;
}

Scene<3> scene(bool deforms) {
  Scene<3> result;
  result.time_step = 0.02;
  Body_start<3> start;
  start.cloud = Particle_cloud{225, 7, 3};
  if (deforms) start.material = Shape_material{Shape_mode::linear, 1, 0.5};
  result.bodies.push_back(start);
  return result;
}

void steps(benchmark::State& state, bool deforms) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(state.range(0)));
  World<3> world(grid(), scene(deforms), {hexahedron_body(0.3, false)});
  for (int i = 0; i < 20; ++i) world.step();
  for (auto _ : state) world.step();
  state.counters["moves"] = benchmark::Counter(static_cast<double>(world.body_counts().moves) *
                                                   static_cast<double>(state.iterations()) /
                                                   static_cast<double>(world.steps_done()),
                                               benchmark::Counter::kIsRate);
}

// As many steps for any number of threads: bodies come to rest.
BENCHMARK_CAPTURE(steps, shape_matching, true)->Arg(1)->Arg(2)->Iterations(1000)->UseRealTime();
BENCHMARK_CAPTURE(steps, rigid_flight, false)->Arg(1)->Arg(2)->Iterations(1000)->UseRealTime();

}  // namespace
