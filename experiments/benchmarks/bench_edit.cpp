// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits of an environment of tetrahedra: vertices that are moved, inside and on the boundary, facets opened
// and closed.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using namespace cellwalk;

constexpr std::size_t points_in_turn = 500;

Environment<3> grid(const benchmark::State& state) {
  Simplex_grid_options<3> options;
  const auto side = static_cast<std::uint32_t>(std::cbrt(static_cast<double>(state.range(0)) / 6) + 0.5);
  options.cells = {side, side, side};
  options.jitter = 0.12;
  return Environment<3>::build(tetrahedral_grid(options));
}

/// Some vertices in random order, of the boundary or not.
std::vector<std::uint32_t> vertices(const Snapshot<3>& snapshot, bool on_boundary) {
  std::vector<std::uint8_t> is_outer(snapshot.points().size());
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = snapshot.half_facet(snapshot.cell(i), k);
      if (snapshot.neighbour(f) != Cell::none) continue;
      for (const std::uint32_t v : snapshot.loop(f)) is_outer[v] = 1;
    }
  std::vector<std::uint32_t> found;
  for (std::uint32_t v = 0; v < is_outer.size(); ++v)
    if ((is_outer[v] != 0) == on_boundary) found.push_back(v);
  Random random(1);
  random.shuffle(found);
  found.resize(std::min(found.size(), points_in_turn));
  return found;
}

/// Vertices go a little way and back. All of it is certified.
void move_vertices(benchmark::State& state, bool on_boundary) {
  Environment<3> environment = grid(state);
  const Snapshot<3>& snapshot = environment.snapshot();
  const std::vector<std::uint32_t> moved = vertices(snapshot, on_boundary);
  std::vector<Point<3>> home;
  for (const std::uint32_t v : moved) home.push_back(snapshot.point(v));
  environment.move_vertex(moved[0], home[0] + Vector<3>{0.01, 0.01, 0.01});  // what is made once
  environment.move_vertex(moved[0], home[0]);
  std::size_t i = 0;
  for (auto _ : state) {
    const std::size_t k = i / 2 % moved.size();
    environment.move_vertex(moved[k], i++ % 2 ? home[k] : home[k] + Vector<3>{0.01, 0.01, 0.01});
  }
  state.counters["tetrahedra"] = static_cast<double>(snapshot.cell_count());
}

void move_inner(benchmark::State& state) { move_vertices(state, false); }
void move_boundary(benchmark::State& state) { move_vertices(state, true); }

/// The first move of a vertex on the boundary, for which boundary facets are put into an R-tree.
void move_boundary_first(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    Environment<3> environment = grid(state);
    const std::uint32_t v = vertices(environment.snapshot(), true)[0];
    const Point<3> target = environment.snapshot().point(v) + Vector<3>{0.01, 0.01, 0.01};
    state.ResumeTiming();
    environment.move_vertex(v, target);
  }
}

void toggle(benchmark::State& state) {
  Environment<3> environment = grid(state);
  const Snapshot<3>& snapshot = environment.snapshot();
  std::size_t i = 0;
  for (auto _ : state) {
    const Cell c = snapshot.cell(i++ % snapshot.cell_count());
    for (std::size_t k = 0; k < 4; ++k) {
      const Half_facet f = snapshot.half_facet(c, k);
      if (snapshot.neighbour(f) == Cell::none) continue;
      environment.set_impassable(f, !snapshot.is_impassable(f));
      break;
    }
  }
}

// So many times each, since making a grid takes much longer than to edit it.
BENCHMARK(move_inner)
    ->Arg(6'000)
    ->Arg(83'000)
    ->Arg(1'000'000)
    ->Iterations(5'000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(move_boundary)
    ->Arg(6'000)
    ->Arg(83'000)
    ->Arg(1'000'000)
    ->Iterations(5'000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(move_boundary_first)->Arg(6'000)->Arg(83'000)->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(toggle)->Arg(6'000)->Arg(1'000'000)->Iterations(100'000)->Unit(benchmark::kMicrosecond);

}  // namespace
