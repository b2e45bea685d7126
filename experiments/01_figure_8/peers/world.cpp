// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world.h"

#include <cellwalk/generators/grid.h>

namespace cellwalk::figure_8 {

Grid_world grid_world(const Trace& trace) {
  Grid_options<3> options;
  options.cells = {trace.nx, trace.ny, trace.nz};
  options.solid_cells = trace.obstacles;
  Grid_world world{&trace, hex_grid(options), {}, {}};
  world.gluing = glue(world.soup);
  world.walls = experiments::wall_mesh(world.soup, world.gluing);
  return world;
}

}  // namespace cellwalk::figure_8
