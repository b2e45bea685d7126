// SPDX-License-Identifier: LGPL-3.0-or-later
// What a second thread brings. Many bodies: the scene of data/hexahedra.json, bodies only, without files: 225
// hexahedra bounce in a grid of 10^3 hexahedral cells, a tenth of them solid. One large body: a soft ring is
// thrown into a sheared grid with solid cells, and its recorded motion is replayed; only the steps of the
// body are timed. The last argument is the number of threads; time is that of the clock.
#include <cellwalk/body/generate.h>
#include <cellwalk/environment/gluing.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>
#include <cellwalk/simulation/world.h>

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
  World<3> world(grid(), scene(deforms), {generate_body(Hexahedron_shape{0.3, false})});
  for (int i = 0; i < 20; ++i) world.step();
  for (auto _ : state) world.step();
  state.counters["moves"] = benchmark::Counter(static_cast<double>(world.body_counts().moves) *
                                                   static_cast<double>(state.iterations()) /
                                                   static_cast<double>(world.steps_done()),
                                               benchmark::Counter::kIsRate);
}

const Snapshot<3>& sheared_grid() {
  static const Snapshot<3> snapshot = [] {
    Grid_options<3> options;
    options.cells = {6, 6, 4};
    options.solid_share = 0.06;
    options.seed = 3;
    options.map = sheared<3>();
    return compile(options);
  }();
  return snapshot;
}

/// A torus of twice as many vertices around as across.
Body_soup<3> ring(std::uint32_t across) {
  const std::uint32_t around = 2 * across;
  Body_soup<3> soup;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
  const auto join = [&](std::uint32_t u, std::uint32_t v) {
    soup.edges.push_back({std::min(u, v), std::max(u, v)});
  };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = 0.8 + 0.25 * std::cos(b);
      soup.points.push_back({r * std::cos(a), r * std::sin(a), 0.25 * std::sin(b)});
      join(at(i, j), at(i + 1, j));
      join(at(i, j), at(i, j + 1));
      join(at(i, j), at(i + 1, j + 1));
    }
  return soup;
}

const Body_trace& motion_of_ring(std::uint32_t across) {
  static std::map<std::uint32_t, Body_trace> motions;
  const auto [motion, is_new] = motions.try_emplace(across);
  if (!is_new) return motion->second;
  Scene<3> thrown;
  thrown.time_step = 0.01;
  thrown.gravity = {0, 0, -9.81};
  thrown.restitution = 0.5;
  thrown.friction = 0.1;
  Body_start<3> start;
  start.cloud = Particle_cloud{1, 2, 1};
  start.material = Shape_material{Shape_mode::quadratic, 0.4, 0.7};
  thrown.bodies.push_back(start);
  World<3> world(sheared_grid(), thrown, {ring(across)});
  Body_trace_recorder recorder(world);
  for (int k = 0; k < 120; ++k) {
    world.step();
    recorder.record_step();
  }
  return motion->second = recorder.trace();
}

void large_body(benchmark::State& state) {
  const Body_trace& motion = motion_of_ring(static_cast<std::uint32_t>(state.range(0)));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(state.range(1)));
  const Locator<3> locator(sheared_grid());
  Body_options options = body_trace_options(Sweep::triangle);
  options.parallel = state.range(1) > 1;
  std::uint64_t moves = 0;
  for (auto _ : state) {
    Body_replay replay(sheared_grid(), locator, motion, options);
    std::chrono::duration<double> passed{};
    for (std::uint32_t k = 0; k < motion.steps; ++k) {
      replay.prepare();
      const auto begin = std::chrono::steady_clock::now();
      replay.step();
      passed += std::chrono::steady_clock::now() - begin;
    }
    state.SetIterationTime(passed.count());
    moves += replay.counts().moves;
  }
  state.counters["vertices"] = static_cast<double>(motion.vertices());
  state.counters["moves"] = benchmark::Counter(static_cast<double>(moves), benchmark::Counter::kIsRate);
}

// As many steps for any number of threads: bodies come to rest.
BENCHMARK_CAPTURE(steps, shape_matching, true)->Arg(1)->Arg(2)->Iterations(1000)->UseRealTime();
BENCHMARK_CAPTURE(steps, rigid_flight, false)->Arg(1)->Arg(2)->Iterations(1000)->UseRealTime();
BENCHMARK(large_body)
    ->ArgsProduct({{40, 100}, {1, 2}})
    ->Iterations(10)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
