// SPDX-License-Identifier: LGPL-3.0-or-later
// The walk from dart to dart of CGAL's combinatorial map beside the walks of the snapshot, on the same
// motions in tetrahedral grids of 10^4, 10^5 and 10^6 cells, all exact.
//
//   warm: 1,000 particles start close together and go there and back: their cells are in the cache.
//   cold: 100,000 particles all over the grid go there and back in turn: data are read from main memory.
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/lcc/walker.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/strategy.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace cellwalk;

struct Is_wall {
  const Map<3>* map;
  bool operator()(const Const_dart<3>& d) const { return map->info(d).is_impassable(); }
};
using Walker = lcc::Walker<Map<3>, Is_wall>;

struct World {
  double side = 0;
  Snapshot<3> snapshot;
  std::unique_ptr<Locator<3>> locator;
  std::unique_ptr<Map_storage<3>> storage;
  std::unique_ptr<Walker> walker;
  std::vector<std::uint32_t> first_facet;  ///< of each cell
};

World& world(std::size_t tetrahedra) {
  static std::map<std::size_t, std::unique_ptr<World>> worlds;
  auto& w = worlds[tetrahedra];
  if (w) return *w;
  w = std::make_unique<World>();
  w->side = std::floor(std::cbrt(static_cast<double>(tetrahedra) / 6) + 0.5);
  Simplex_grid_options<3> options;
  options.cells = Grid_options<3>::filled(static_cast<std::uint32_t>(w->side));
  options.jitter = 0.12;
  const Cell_soup<3> soup = tetrahedral_grid(options);
  const Gluing gluing = glue(soup);
  w->snapshot = Snapshot<3>::compile(soup, gluing);
  w->locator = std::make_unique<Locator<3>>(w->snapshot);
  w->storage = build_map(soup, gluing);
  w->walker = std::make_unique<Walker>(w->storage->map, Is_wall{&w->storage->map});
  w->first_facet.assign(soup.cell_begin.begin(), soup.cell_begin.end());
  return *w;
}

/// Starts, and targets up to two cubes away along each axis.
struct Motions {
  std::vector<Particle<3>> particles;
  std::vector<Point<3>> targets;

  Motions(const World& w, bool is_cold) {
    std::mt19937_64 random(5);
    const double reach = is_cold ? w.side / 2 - 1 : 1.5;
    std::uniform_real_distribution<double> start(-reach, reach), step(-2, 2);
    const auto inside = [&](double x) { return std::clamp(x, 0.25, w.side - 0.25); };
    const std::size_t count = is_cold ? 100'000 : 1'000;
    while (particles.size() < count) {
      Point<3> a, b;
      for (std::size_t i = 0; i < 3; ++i) {
        a[i] = inside(w.side / 2 + start(random));
        b[i] = inside(a[i] + step(random));
      }
      if (const auto particle = w.locator->particle_at(a)) {
        particles.push_back(*particle);
        targets.push_back(b);
      }
    }
  }
};

void report(benchmark::State& state, std::uint64_t crossings, std::uint64_t signs) {
  const auto moves = static_cast<double>(state.iterations());
  state.counters["crossings"] = static_cast<double>(crossings) / moves;
  state.counters["signs"] = static_cast<double>(signs) / moves;
  state.counters["per_crossing"] = benchmark::Counter(
      static_cast<double>(crossings), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void on_map(benchmark::State& state, bool is_cold) {
  World& w = world(static_cast<std::size_t>(state.range(0)));
  const Motions motions(w, is_cold);
  std::vector<lcc::Particle<Map<3>>> particles;
  std::vector<Map<3>::Point> targets;
  for (const Particle<3>& p : motions.particles)
    particles.push_back(
        {to_map_point(p.position), w.storage->dart_of_half_facet[w.first_facet[w.snapshot.index(p.cell)]]});
  for (const Point<3>& b : motions.targets) targets.push_back(to_map_point(b));
  lcc::Counts counts;
  std::size_t k = 0;
  for (auto _ : state) {
    const Map<3>::Point from = particles[k].position;
    benchmark::DoNotOptimize(w.walker->move(particles[k], targets[k], counts));
    targets[k] = from;
    if (++k == particles.size()) k = 0;
  }
  report(state, counts.crossings, counts.signs);
}

void on_snapshot(benchmark::State& state, bool is_cold, Walk_strategy strategy) {
  World& w = world(static_cast<std::size_t>(state.range(0)));
  Motions motions(w, is_cold);
  Walk_counts counts;
  std::size_t k = 0;
  for (auto _ : state) {
    const Point<3> from = motions.particles[k].position;
    benchmark::DoNotOptimize(
        move<Exact>(w.snapshot, motions.particles[k], motions.targets[k], counts, strategy));
    motions.targets[k] = from;
    if (++k == motions.particles.size()) k = 0;
  }
  report(state, counts.crossings, counts.predicates.orientations);
}

[[maybe_unused]] const int registered = [] {
  for (const bool is_cold : {false, true})
    for (const long tetrahedra : {10'000, 100'000, 1'000'000}) {
      const std::string where = is_cold ? "/cold" : "/warm";
      benchmark::RegisterBenchmark(("map" + where).c_str(), on_map, is_cold)->Arg(tetrahedra);
      benchmark::RegisterBenchmark(("snapshot_simplex" + where).c_str(), on_snapshot, is_cold,
                                   Walk_strategy::predictive_simplex)
          ->Arg(tetrahedra);
      benchmark::RegisterBenchmark(("snapshot" + where).c_str(), on_snapshot, is_cold,
                                   Walk_strategy::certified)
          ->Arg(tetrahedra);
    }
  return 0;
}();

}  // namespace
