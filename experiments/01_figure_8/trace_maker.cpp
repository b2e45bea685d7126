// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace_maker.h"

#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "motions.h"
#include "peers/hexahedra_trace.h"

namespace cellwalk::figure_8 {
namespace {

/// The largest share of cells of which no two touch.
constexpr double largest_apart = 0.125;
std::vector<std::uint32_t> solid_cells(const Trace_options& options) {
  const auto count = static_cast<std::uint32_t>(options.cells[0] * options.cells[1] * options.cells[2]);
  std::vector<std::uint32_t> cells;
  if (options.solid_share <= largest_apart) {
    Grid_options<3> grid;
    grid.cells = options.cells;
    grid.solid_share = options.solid_share;
    grid.seed = options.seed;
    const Cell_soup<3> soup = hex_grid(grid);
    for (std::uint32_t c = 0; c < count; ++c)
      if (soup.solid[c]) cells.push_back(c);
    return cells;
  }
  for (std::uint32_t c = 0; c < count; ++c) cells.push_back(c);
  Random random(options.seed);
  random.shuffle(cells);
  cells.resize(static_cast<std::size_t>(options.solid_share * count));
  std::ranges::sort(cells);
  return cells;
}

}  // namespace

Made_trace make_trace(const Trace_options& options) {
  Body_trace start;
  start.touch_blocks = true;
  start.grid = {options.cells, solid_cells(options)};
  start.bodies.assign(options.bodies, hexahedron());
  const Environment<3> environment = trace_environment(*start.grid);
  const auto record = options.motion == Motion::rigid ? record_rigid : record_deforming;
  return record(environment.snapshot(), std::move(start), options);
}

}  // namespace cellwalk::figure_8
