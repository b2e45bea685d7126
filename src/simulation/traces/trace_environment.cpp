// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <utility>

namespace cellwalk {

Environment<3> trace_environment(const Traced_grid& grid, const Lattice_map<3>& map) {
  Grid_options<3> options;
  options.cells = grid.cells;
  options.solid_cells = grid.solid;
  options.map = map;
  return Environment<3>::build(hex_grid(options), {.split = false, .keep_map = false});
}

Body_trace mapped(Body_trace trace, const Lattice_map<3>& map) {
  for (Point<3>& x : trace.before) x = map(x);
  for (Point<3>& x : trace.targets) x = map(x);
  return trace;
}

}  // namespace cellwalk
