// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that close and open, and cells that are filled and excavated, in grids of tetrahedra of any size,
// with a body beside them or none. Nanoseconds of processor time a change; the least of many repeats.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/processor_time.h"

namespace {

using namespace cellwalk;

Environment<3> grid_of(std::size_t cells) {
  Simplex_grid_options<3> options;
  options.cells.fill(static_cast<std::uint32_t>(std::lround(std::cbrt(static_cast<double>(cells) / 6))));
  return Environment<3>::build(tetrahedral_grid(options));
}

/// A rod of four edges in the middle of the grid, through some cells.
Body<3> rod_in(const Environment<3>& environment, const Point<3>& middle) {
  Body_soup<3> soup;
  for (std::uint32_t i = 0; i < 5; ++i)
    soup.points.push_back(
        {middle[0] + 0.4 * i - 0.83, middle[1] + 0.03 * i + 0.21, middle[2] + 0.02 * i + 0.13});
  for (std::uint32_t i = 1; i < 5; ++i) soup.edges.push_back({i - 1, i});
  return {environment.snapshot(), Locator<3>(environment.snapshot()), soup};
}

struct Least {
  double seconds = std::numeric_limits<double>::infinity();
  template <class Change>
  void measure(std::size_t count, const Change& change) {
    const double start = experiments::processor_seconds();
    for (std::size_t k = 0; k < count; ++k) change(k);
    seconds = std::min(seconds, (experiments::processor_seconds() - start) / static_cast<double>(count));
  }
  double nanoseconds() const { return 1e9 * seconds; }
};

void toggle(benchmark::State& state) {
  Environment<3> environment = grid_of(static_cast<std::size_t>(state.range(0)));
  const Snapshot<3>& snapshot = environment.snapshot();
  const bool has_body = state.range(1) != 0;
  const auto side = std::round(std::cbrt(static_cast<double>(snapshot.cell_count()) / 6));
  Point<3> middle{};
  middle.fill(std::floor(side / 2));
  Body<3> rod = rod_in(environment, middle);
  // Facets of the cells about the rod that it does not pass, and cells in which nothing is.
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell_view<3> view = snapshot.view(snapshot.cell(i));
    bool is_near = true;
    for (std::size_t v = 0; v < 4; ++v)
      for (std::size_t k = 0; k < 3; ++k) is_near &= std::abs(view.point(v)[k] - middle[k]) <= 1;
    if (is_near) cells.push_back(snapshot.cell(i));
  }
  std::vector<Half_facet> facets;
  Residents<3> residents;
  if (has_body) residents.bodies = {&rod};
  Reshaping<3> reshaping(environment, residents);
  std::vector<Cell> empty;
  for (const Cell c : cells) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(c, k);
      if (snapshot.is_impassable(f) || !reshaping.close(f).is_made) continue;
      reshaping.open(f);
      facets.push_back(f);
    }
    if (!reshaping.fill(c).is_made) continue;
    reshaping.excavate(c);
    empty.push_back(c);
  }
  Least close, open, fill, excavate;
  for (auto _ : state) {
    close.measure(facets.size(),
                  [&](std::size_t k) { benchmark::DoNotOptimize(reshaping.close(facets[k]).is_made); });
    open.measure(facets.size(),
                 [&](std::size_t k) { benchmark::DoNotOptimize(reshaping.open(facets[k]).is_made); });
    fill.measure(empty.size(),
                 [&](std::size_t k) { benchmark::DoNotOptimize(reshaping.fill(empty[k]).is_made); });
    excavate.measure(empty.size(),
                     [&](std::size_t k) { benchmark::DoNotOptimize(reshaping.excavate(empty[k]).is_made); });
  }
  state.counters["cells"] = static_cast<double>(snapshot.cell_count());
  state.counters["close"] = close.nanoseconds();
  state.counters["open"] = open.nanoseconds();
  state.counters["fill"] = fill.nanoseconds();
  state.counters["excavate"] = excavate.nanoseconds();
}

BENCHMARK(toggle)->ArgsProduct({{1'000, 10'000, 100'000, 1'000'000}, {0, 1}})->Iterations(200);

}  // namespace
