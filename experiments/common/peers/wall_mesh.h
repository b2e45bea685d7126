// SPDX-License-Identifier: LGPL-3.0-or-later
// The triangles of walls: what the structures of peers are built from.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_MESH_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_MESH_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::experiments {

/// Triangles that cover every wall once.
struct Wall_mesh {
  std::vector<Point<3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  const Point<3>& corner(std::size_t triangle, std::size_t k) const { return points[triangles[triangle][k]]; }
};

/// From which side a triangle of a wall is counterclockwise.
enum class Facing {
  first,  ///< from outside the cell with the lower facet
  wall,   ///< from inside the wall, seen from free space clockwise. A membrane has two triangles in a place
};

/// Each impassable facet and each facet of the boundary, cut into a fan, once however many cells it bounds.
Wall_mesh wall_mesh(const Cell_soup<3>& soup, const Gluing& gluing, Facing facing = Facing::first);

/// The volume of free space.
/// \pre walls that face the wall, and enclose it
double enclosed_volume(const Wall_mesh& walls);

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_MESH_H
