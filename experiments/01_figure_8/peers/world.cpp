// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world.h"

#include <cellwalk/generators/grid.h>

#include <span>

namespace cellwalk::figure_8 {

Wall_mesh wall_mesh(const Cell_soup<3>& soup, const Gluing& gluing) {
  constexpr std::uint32_t unused = 0xffffffffu;
  Wall_mesh mesh;
  std::vector<std::uint32_t> number(soup.points.size(), unused);
  const auto use = [&](std::uint32_t point) {
    if (number[point] == unused) {
      number[point] = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(soup.points[point]);
    }
    return number[point];
  };
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t other = gluing.opposite[f];
    const bool is_wall = other == no_facet || soup.impassable[f] || soup.impassable[other];
    if (!is_wall || (other != no_facet && other < f)) continue;
    const std::span<const std::uint32_t> loop = soup.facet(f);
    for (std::size_t i = 2; i < loop.size(); ++i)
      mesh.triangles.push_back({use(loop[0]), use(loop[i - 1]), use(loop[i])});
  }
  return mesh;
}

Grid_world grid_world(const Trace& trace) {
  Grid_options<3> options;
  options.cells = {trace.nx, trace.ny, trace.nz};
  options.solid_cells = trace.obstacles;
  Grid_world world{&trace, hex_grid(options), {}, {}};
  world.gluing = glue(world.soup);
  world.walls = wall_mesh(world.soup, world.gluing);
  return world;
}

}  // namespace cellwalk::figure_8
