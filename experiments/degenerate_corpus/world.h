// SPDX-License-Identifier: LGPL-3.0-or-later
// The worlds of the corpus: small complexes full of degeneracies, with their walls as segments or triangles.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_WORLD_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_WORLD_H

#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "exact.h"

namespace cellwalk::corpus {

/// What is behind a wall.
enum class Wall_kind : std::uint8_t {
  solid,     ///< no free space
  membrane,  ///< free space: one wall with two free sides
  slit       ///< free space behind another wall in the same place
};
inline constexpr std::array<const char*, 3> wall_kind_names{"solid", "membrane", "slit"};

/// A wall as a simplex: a part of an impassable facet. Its normal (2D: its left side) is free.
template <int D>
struct Wall {
  std::array<std::uint32_t, D> corners;
  std::uint32_t facet = 0;  ///< walls of one facet have the same number
  Wall_kind kind = Wall_kind::solid;
};

template <int D>
struct World {
  std::string name;
  Cell_soup<D> soup;
  std::vector<Wall<D>> walls;
  std::vector<std::uint32_t> vertices;              ///< of walls, ascending
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< sides of walls but for those within a facet (3D)
  /// Walls, and these, as rational points.
  std::vector<std::vector<Vec>> wall_points, edge_points, vertex_points;
};

/// All worlds in which objects move, in order.
template <int D>
std::vector<World<D>> make_worlds();

/// All worlds in which walls move: their cells are simplices.
template <int D>
std::vector<World<D>> make_moving_worlds();

/// Puts a vertex of the walls elsewhere, as a rational point only.
template <int D>
void place_vertex(World<D>& world, std::uint32_t vertex, const Vec& place);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_WORLD_H
