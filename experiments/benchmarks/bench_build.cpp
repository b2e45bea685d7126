// SPDX-License-Identifier: LGPL-3.0-or-later
// From a soup of tetrahedra to a certified environment: time, and bytes a tetrahedron, of each stage.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/walk/locate.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace cellwalk;

Cell_soup<3> soup_of(const benchmark::State& state) {
  Simplex_grid_options<3> options;
  const auto side = static_cast<std::uint32_t>(std::cbrt(static_cast<double>(state.range(0)) / 6) + 0.5);
  options.cells = {side, side, side};
  options.jitter = 0.12;
  return tetrahedral_grid(options);
}

/// The same cells and points in random order: the worst that a file can do to the cache.
Cell_soup<3> shuffled(const Cell_soup<3>& soup) {
  Random random(1);
  std::vector<std::uint32_t> cells(soup.cell_count()), places(soup.points.size());
  std::iota(cells.begin(), cells.end(), 0);
  std::iota(places.begin(), places.end(), 0);
  random.shuffle(cells);
  random.shuffle(places);
  Cell_soup<3> other;
  other.points.resize(soup.points.size());
  for (std::size_t i = 0; i < places.size(); ++i) other.points[places[i]] = soup.points[i];
  for (const std::uint32_t c : cells) {
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      std::vector<std::uint32_t> loop;
      for (const std::uint32_t v : soup.facet(f)) loop.push_back(places[v]);
      other.add_facet(loop);
    }
    other.end_cell();
  }
  return other;
}

void report(benchmark::State& state, std::size_t cells, std::size_t bytes) {
  state.counters["tetrahedra"] = static_cast<double>(cells);
  if (bytes > 0)
    state.counters["bytes_per_tetrahedron"] = static_cast<double>(bytes) / static_cast<double>(cells);
}

/// The whole way: duplicates, check of every cell, gluing, map, snapshot, certification.
void build(benchmark::State& state, const Cell_soup<3>& soup) {
  std::size_t bytes = 0, map_bytes = 0;
  for (auto _ : state) {
    const Environment<3> environment = Environment<3>::build(soup);
    bytes = environment.snapshot().bytes();
    map_bytes = environment.storage().map.bytes();
  }
  report(state, soup.cell_count(), bytes);
  state.counters["map_bytes_per_tetrahedron"] =
      static_cast<double>(map_bytes) / static_cast<double>(soup.cell_count());
}

void build_environment(benchmark::State& state) { build(state, soup_of(state)); }
void build_shuffled_environment(benchmark::State& state) { build(state, shuffled(soup_of(state))); }

/// The same without a map: what a program that never edits does.
void build_frozen(benchmark::State& state, const Cell_soup<3>& soup) {
  Build_options options;
  options.keep_map = false;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const Environment<3> environment = Environment<3>::build(soup, options);
    bytes = environment.snapshot().bytes();
  }
  report(state, soup.cell_count(), bytes);
}

void build_frozen_environment(benchmark::State& state) { build_frozen(state, soup_of(state)); }
void build_shuffled_frozen_environment(benchmark::State& state) {
  build_frozen(state, shuffled(soup_of(state)));
}

void thaw_environment(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  Environment<3> environment = Environment<3>::build(soup);
  for (auto _ : state) {
    state.PauseTiming();
    environment.freeze();
    state.ResumeTiming();
    environment.thaw();
  }
  report(state, soup.cell_count(), 0);
}

void compact_environment(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  Environment<3> environment = Environment<3>::build(soup);
  for (auto _ : state) benchmark::DoNotOptimize(environment.compact());
  report(state, soup.cell_count(), 0);
}

/// What a program does with a file `*.cellwalk` that is in the cache of files.
void open_environment(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  const std::string path = std::filesystem::temp_directory_path() / "bench_build.cellwalk";
  {
    Build_report built;
    Environment<3> environment = Environment<3>::build(soup, {.keep_map = false}, &built);
    io::Atomic_file file(path);
    write_environment<3>(file, environment, built.certificate, {});
    file.commit();
  }
  for (auto _ : state) benchmark::DoNotOptimize(load_environment(path, {.keep_map = false}));
  report(state, soup.cell_count(), std::filesystem::file_size(path));
  std::filesystem::remove(path);
}

void glue_soup(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(glue(soup));
  report(state, soup.cell_count(), 0);
}

void compile_snapshot(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  const Gluing gluing = glue(soup);
  for (auto _ : state) benchmark::DoNotOptimize(Snapshot<3>::compile(soup, gluing));
  report(state, soup.cell_count(), 0);
}

void certify_snapshot(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
  for (auto _ : state) benchmark::DoNotOptimize(certify(snapshot));
  report(state, soup.cell_count(), 0);
}

void build_locator(benchmark::State& state) {
  const Cell_soup<3> soup = soup_of(state);
  const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
  for (auto _ : state) benchmark::DoNotOptimize(Locator<3>(snapshot));
  report(state, soup.cell_count(), 0);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Arg(100000)->Arg(1000000)->ArgName("tetrahedra")->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(build_environment)->Apply(sizes);
BENCHMARK(build_shuffled_environment)->Apply(sizes);
BENCHMARK(build_frozen_environment)->Apply(sizes);
BENCHMARK(build_shuffled_frozen_environment)->Apply(sizes);
BENCHMARK(thaw_environment)->Apply(sizes);
BENCHMARK(compact_environment)->Apply(sizes);
BENCHMARK(open_environment)->Apply(sizes);
BENCHMARK(glue_soup)->Apply(sizes);
BENCHMARK(compile_snapshot)->Apply(sizes);
BENCHMARK(certify_snapshot)->Apply(sizes);
BENCHMARK(build_locator)->Apply(sizes);

}  // namespace
