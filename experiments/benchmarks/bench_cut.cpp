// SPDX-License-Identifier: LGPL-3.0-or-later
// Cuts of the same size in blocks of solid tetrahedra of any size: microseconds of processor time for each
// solid cell that the blade meets. The first cut of an environment finds where its tissue is.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/reshape/reshaping.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace {

using namespace cellwalk;

/// A cube of tetrahedra, all solid but for the uppermost fifth.
Environment<3> tissue_of(std::int64_t cells) {
  Simplex_grid_options<3> options;
  const auto side = static_cast<std::uint32_t>(std::lround(std::cbrt(static_cast<double>(cells) / 6)));
  options.cells.fill(side);
  options.jitter = 0.12;
  Cell_soup<3> soup = tetrahedral_grid(options);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    double height = 0;
    std::size_t corners = 0;
    for (std::size_t i = soup.facet_begin[soup.cell_begin[c]]; i < soup.facet_begin[soup.cell_begin[c + 1]];
         ++i) {
      height += soup.points[soup.vertices[i]][2];
      ++corners;
    }
    soup.solid[c] = height < 0.8 * side * static_cast<double>(corners);
  }
  return Environment<3>::build(std::move(soup));
}

/// A vertical blade of three by two cells that reaches from above the tissue into it.
Blade<3> blade_at(double x, double y, double surface) {
  const std::array<Point<3>, 4> corners{{{x, y, surface + 1.3},
                                         {x + 0.2, y + 3, surface + 1.3},
                                         {x + 0.3, y + 3, surface - 2.2},
                                         {x + 0.1, y, surface - 2.2}}};
  return blade_along<3>(corners);
}

void cut(benchmark::State& state) {
  Environment<3> environment = tissue_of(state.range(0));
  const double side = std::round(std::cbrt(static_cast<double>(environment.snapshot().cell_count()) / 6));
  double first = 0;
  std::vector<double> microseconds;
  std::size_t cells = 0, cuts = 0;
  for (auto _ : state) {
    Reshaping<3> reshaping(environment, {});
    for (double x = 1.4; x < std::min(side - 2, 14.0); x += 3)
      for (double y = 1.4; y < std::min(side - 4, 14.0); y += 4) {
        const double start = experiments::processor_seconds();
        const Cut_report report = reshaping.cut(blade_at(x, y, 0.8 * side));
        const double seconds = experiments::processor_seconds() - start;
        if (cuts++ == 0)
          first = seconds;
        else if (report.cells != 0)
          microseconds.push_back(1e6 * seconds / static_cast<double>(report.cells));
        cells += report.cells;
      }
    reshaping.finish();
  }
  state.counters["cells"] = static_cast<double>(environment.snapshot().cell_count());
  state.counters["cuts"] = static_cast<double>(cuts);
  state.counters["met"] = static_cast<double>(cells);
  state.counters["us_a_cell_met"] = experiments::median(microseconds);
  state.counters["first_ms"] = 1e3 * first;
}

BENCHMARK(cut)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Iterations(1);

}  // namespace
