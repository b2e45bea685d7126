// SPDX-License-Identifier: LGPL-3.0-or-later
// The cost of a move: staying in a cell, and crossing facets, in tetrahedral grids of 10^4, 10^5 and 10^6
// cells, beside point location by CGAL's triangulation with the start as a hint, on the same points and
// motions in the same run.
//
//   repeated: 200 particles start close together and are moved again and again. All their data are in the
//             cache, and the processor learns their branches by heart, as in no real program.
//   warm:     the same with 4,000 particles: the cells are in the cache, the paths are too many to learn.
//   cold:     100,000 particles all over the grid, moved once each: data are read from main memory.
//
// "crossing" subtracts nothing: it is the time of a whole move divided by the number of facets crossed (or
// tetrahedra visited).
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/strategy.h>
#include <cellwalk/walk/trace.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <vector>

namespace {

using namespace cellwalk;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

/// A jittered grid of about n tetrahedra, and the Delaunay triangulation of its points (about as many).
struct World {
  std::size_t side;
  Snapshot<3> snapshot;
  std::unique_ptr<Locator<3>> locator;
  Delaunay delaunay;
};

std::size_t cubes_along_axis(std::size_t tetrahedra) {
  return static_cast<std::size_t>(std::cbrt(static_cast<double>(tetrahedra) / 6) + 0.5);
}

World& world(std::size_t tetrahedra) {
  static std::map<std::size_t, std::unique_ptr<World>> worlds;
  auto& w = worlds[tetrahedra];
  if (w) return *w;
  w = std::make_unique<World>();
  w->side = cubes_along_axis(tetrahedra);
  Simplex_grid_options<3> options;
  options.cells = Grid_options<3>::filled(static_cast<std::uint32_t>(w->side));
  options.jitter = 0.12;
  const Cell_soup<3> soup = tetrahedral_grid(options);
  w->snapshot = Snapshot<3>::compile(soup, glue(soup));
  w->locator = std::make_unique<Locator<3>>(w->snapshot);
  std::vector<Kernel::Point_3> points;
  for (const Point<3>& p : soup.points) points.emplace_back(p[0], p[1], p[2]);
  w->delaunay.insert(points.begin(), points.end());
  return *w;
}

/// Particles that go there and back, and the same for locate: the last answer is the next hint. `reach` is
/// the largest displacement along an axis, in cubes.
struct Motions {
  std::vector<Particle<3>> particles;
  std::vector<Delaunay::Cell_handle> hints;
  std::array<std::vector<Point<3>>, 2> targets;  ///< of every other round
  bool back = false;

  const std::vector<Point<3>>& next_targets() {
    back = !back;
    return targets[back ? 0 : 1];
  }
};

enum class Start { repeated, warm, cold };

Motions motions(const World& w, Start start, double reach) {
  std::mt19937_64 random(5);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  const double side = static_cast<double>(w.side), spread = start == Start::cold ? side - 2 : 1;
  Motions m;
  const std::size_t count = start == Start::repeated ? 200 : start == Start::warm ? 4000 : 100000;
  for (std::size_t i = 0; i < count; ++i) {
    Point<3> p, t;
    for (int k = 0; k < 3; ++k) {
      p[k] = side / 2 + spread * (unit() - 0.5);
      t[k] = std::clamp(p[k] + reach * (2 * unit() - 1), 0.5, side - 0.5);
    }
    m.particles.push_back(w.locator->particle_at(p).value());
    m.targets[0].push_back(t);
    m.targets[1].push_back(p);
    m.hints.push_back(w.delaunay.locate({p[0], p[1], p[2]}));
  }
  return m;
}

/// Seconds a move and a crossing, and how many of these a move has.
void report(benchmark::State& state, double moves, double crossings) {
  const auto time_per = benchmark::Counter::kIsRate | benchmark::Counter::kInvert;
  state.counters["time_per_move"] = benchmark::Counter(moves, time_per);
  if (crossings < moves) return;  // most moves stay in their cell
  state.counters["time_per_crossing"] = benchmark::Counter(crossings, time_per);
  state.counters["crossings_per_move"] = crossings / moves;
}

/// A displacement of 10^-7 cubes: practically every move stays in its cell.
constexpr double no_reach = 1e-7;
constexpr double long_reach = 4;

template <class Policy, Walk_strategy strategy>
void cellwalk_moves(benchmark::State& state, Start start, double reach) {
  World& w = world(static_cast<std::size_t>(state.range(0)));
  Motions m = motions(w, start, reach);
  Walk_counts counts;
  for (auto _ : state) {
    const std::vector<Point<3>>& targets = m.next_targets();
    std::size_t blocked = 0;
    for (std::size_t i = 0; i < targets.size(); ++i)
      blocked += cellwalk::move<Policy>(w.snapshot, m.particles[i], targets[i], counts, strategy).status !=
                 Walk_status::arrived;
    if (blocked != 0) state.SkipWithError("a particle met a wall");
  }
  report(state, static_cast<double>(counts.walks), static_cast<double>(counts.crossings));
  const auto cells = static_cast<double>(counts.crossings + counts.walks);
  state.counters["signs_per_cell"] = static_cast<double>(counts.predicates.orientations) / cells;
  state.counters["fallbacks_per_cell"] = static_cast<double>(counts.predicates.fallbacks) / cells;
  state.counters["bytes_per_tetrahedron"] =
      static_cast<double>(w.snapshot.bytes()) / static_cast<double>(w.snapshot.cell_count());
}

/// Walks with the lengths of their pieces, all in one call.
void traces(benchmark::State& state, Start start, double reach) {
  World& w = world(static_cast<std::size_t>(state.range(0)));
  Motions m = motions(w, start, reach);
  const Tracer<3> tracer(w.snapshot);
  Traces rows;
  Walk_counts counts;
  for (auto _ : state) {
    rows.clear();
    tracer.trace(m.particles, m.next_targets(), rows, counts);
    benchmark::DoNotOptimize(rows.lengths.data());
  }
  report(state, static_cast<double>(counts.walks), static_cast<double>(counts.crossings));
}

void cgal_locate(benchmark::State& state, Start start, double reach) {
  World& w = world(static_cast<std::size_t>(state.range(0)));
  Motions m = motions(w, start, reach);
  double moves = 0;
  for (auto _ : state) {
    const std::vector<Point<3>>& targets = m.next_targets();
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Point<3>& t = targets[i];
      m.hints[i] = w.delaunay.locate({t[0], t[1], t[2]}, m.hints[i]);
    }
    moves += static_cast<double>(targets.size());
  }
  report(state, moves, 0);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Arg(10000)->Arg(100000)->Arg(1000000)->ArgName("tetrahedra");
}

constexpr auto certified = Walk_strategy::certified;
constexpr auto rule = Walk_strategy::exit_rule;
constexpr auto predictive = Walk_strategy::predictive_simplex;

void stay(benchmark::State& s) { cellwalk_moves<Exact, certified>(s, Start::repeated, no_reach); }
void stay_cold(benchmark::State& s) { cellwalk_moves<Exact, certified>(s, Start::cold, no_reach); }
void stay_cgal_locate(benchmark::State& s) { cgal_locate(s, Start::repeated, no_reach); }
void stay_cold_cgal_locate(benchmark::State& s) { cgal_locate(s, Start::cold, no_reach); }
void cross_repeated(benchmark::State& s) { cellwalk_moves<Exact, certified>(s, Start::repeated, long_reach); }
void cross_repeated_cgal_locate(benchmark::State& s) { cgal_locate(s, Start::repeated, long_reach); }
void cross_warm(benchmark::State& s) { cellwalk_moves<Exact, certified>(s, Start::warm, long_reach); }
void cross_warm_exit_rule(benchmark::State& s) { cellwalk_moves<Exact, rule>(s, Start::warm, long_reach); }
void cross_warm_predictive(benchmark::State& s) {
  cellwalk_moves<Exact, predictive>(s, Start::warm, long_reach);
}
void cross_warm_double(benchmark::State& s) { cellwalk_moves<Double, rule>(s, Start::warm, long_reach); }
void cross_warm_lazy(benchmark::State& s) { cellwalk_moves<Lazy, rule>(s, Start::warm, long_reach); }
void cross_warm_cgal_locate(benchmark::State& s) { cgal_locate(s, Start::warm, long_reach); }
void cross_cold(benchmark::State& s) { cellwalk_moves<Exact, certified>(s, Start::cold, long_reach); }
void cross_cold_double(benchmark::State& s) { cellwalk_moves<Double, rule>(s, Start::cold, long_reach); }
void trace_repeated(benchmark::State& s) { traces(s, Start::repeated, long_reach); }
void trace_warm(benchmark::State& s) { traces(s, Start::warm, long_reach); }
void trace_cold(benchmark::State& s) { traces(s, Start::cold, long_reach); }
void cross_cold_cgal_locate(benchmark::State& s) { cgal_locate(s, Start::cold, long_reach); }

BENCHMARK(stay)->Apply(sizes);
BENCHMARK(stay_cgal_locate)->Apply(sizes);
BENCHMARK(stay_cold)->Apply(sizes);
BENCHMARK(stay_cold_cgal_locate)->Apply(sizes);
BENCHMARK(cross_repeated)->Apply(sizes);
BENCHMARK(cross_repeated_cgal_locate)->Apply(sizes);
BENCHMARK(cross_warm)->Apply(sizes);
BENCHMARK(cross_warm_cgal_locate)->Apply(sizes);
BENCHMARK(cross_cold)->Apply(sizes);
BENCHMARK(cross_cold_cgal_locate)->Apply(sizes);
BENCHMARK(trace_repeated)->Apply(sizes);
BENCHMARK(trace_warm)->Apply(sizes);
BENCHMARK(trace_cold)->Apply(sizes);
BENCHMARK(cross_warm_exit_rule)->Apply(sizes);
BENCHMARK(cross_warm_predictive)->Apply(sizes);
BENCHMARK(cross_warm_double)->Apply(sizes);
BENCHMARK(cross_cold_double)->Apply(sizes);
BENCHMARK(cross_warm_lazy)->Arg(10000)->ArgName("tetrahedra");

}  // namespace
