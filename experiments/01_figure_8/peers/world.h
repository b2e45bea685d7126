// SPDX-License-Identifier: LGPL-3.0-or-later
// A world in the two forms that peers are built from: its cells, and the triangles of its walls.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H

#include <cellwalk/environment/gluing.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::figure_8 {

/// Triangles that cover every wall once.
struct Wall_mesh {
  std::vector<Point<3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  const Point<3>& corner(std::size_t triangle, std::size_t k) const { return points[triangles[triangle][k]]; }
};

/// Each impassable facet and each facet of the boundary, cut into a fan, once however many cells it bounds.
Wall_mesh wall_mesh(const Cell_soup<3>& soup, const Gluing& gluing);

struct World {
  std::array<std::uint32_t, 3> cells{};    ///< of the grid; for the bound that knows it
  std::vector<std::uint32_t> solid_cells;  ///< likewise
  Cell_soup<3> soup;
  Gluing gluing;
  Wall_mesh walls;

  /// The cell that holds a point. \pre the point lies in the grid and in no facet
  std::uint32_t cell_at(const Point<3>& p) const {
    std::array<std::uint32_t, 3> i;
    for (std::size_t k = 0; k < 3; ++k) i[k] = static_cast<std::uint32_t>(p[k]);
    return i[0] + cells[0] * (i[1] + cells[1] * i[2]);
  }
  std::size_t cell_count() const { return soup.cell_count(); }
};

/// The grid of unit cubes with these solid cells.
World grid_world(const std::array<std::uint32_t, 3>& cells, std::vector<std::uint32_t> solid_cells);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_WORLD_H
