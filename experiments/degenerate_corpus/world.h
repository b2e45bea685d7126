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
  /// Walls, their sides but for those within a facet (3D), and their vertices, as rational points.
  std::vector<std::vector<Vec>> wall_points, edge_points, vertex_points;
};

/// All worlds, in order.
template <int D>
std::vector<World<D>> make_worlds();

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_WORLD_H
