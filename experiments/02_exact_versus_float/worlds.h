// SPDX-License-Identifier: LGPL-3.0-or-later
// The worlds of the experiment: lattices full of degeneracies, placed where one likes, every coordinate
// exactly a double, or rounded to one; and meshes.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WORLDS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WORLDS_H

#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace cellwalk::exact_float {

/// Where a point of the experiment lies. The defaults are those of the points that vary something else.
struct Setting {
  /// Log2 of the distance from a degeneracy; -1: 0 for half of the motions, up to 2^10 for the others.
  int ulps = -1;
  bool on_degeneracy = false;  ///< all motions at distance 0; `ulps` does not count
  int scale = 0;               ///< log2 of the size of a cell
  int offset = -1;     ///< log2 of the distance from the origin along each axis, in cells; -1: at the origin
  int aspect = 0;      ///< log2 of the aspect ratio of the cells
  double turn = 0.25;  ///< the lattice is turned by an angle; tangent of its half
  double length = 1;   ///< of a motion, in cells, along the longest axis of the lattice
  bool is_wide = false;  ///< a large world with few walls, for long motions
  /// The lattice is turned by the exact matrix, and its points are rounded to doubles. All cells are then
  /// simplices, as facets of more corners would not stay planar.
  bool is_rounded = false;
};

/// A lattice of cubes (squares) of mixed shapes with walls, membranes, solid and missing cells.
template <int D>
struct World {
  Cell_soup<D> soup;
  Lattice_map<D> map;
  std::array<std::uint32_t, D> cells{};
  double unit = 0;  ///< one ulp of the largest coordinates in it
};

/// Where a setting places the lattice; rounded points of it are the images that the map computes.
template <int D>
Lattice_map<D> lattice_map(const Setting& setting);

/// \throw Error(usage) for a setting in which coordinates would be rounded
template <int D>
World<D> make_world(const Setting& setting, std::uint64_t seed);

/// One half of the motions lead from a point of the lattice (multiples of 1/8 of a cell) to another, so that
/// they start, end, and pass on facets, edges and vertices more often than not, exactly. The others start
/// anywhere, with all bits of a double, and lead to such a point exactly, or past it as nearly as doubles
/// allow. Then the target is moved by the distance of the setting along a random axis, either way.
template <int D>
struct Motion {
  Point<D> from, to;
};
template <int D>
Motion<D> make_motion(const World<D>& world, const Setting& setting, Random& random);

/// A mesh of tetrahedra from a file, with the neighbours of its cells.
struct Mesh_world {
  Cell_soup<3> soup;
  std::vector<std::uint32_t> opposite;  ///< half-facets of neighbours, as Gluing has them
  std::vector<std::uint32_t> cell_of;   ///< of each half-facet
};
/// \throw Error(input) for a file without cells in space
Mesh_world read_mesh_world(const std::filesystem::path& file);

/// From a vertex, an edge, a facet or the inside of a cell to one of a cell nearby, or past it; points of
/// edges and facets are rounded.
Motion<3> make_motion(const Mesh_world& world, Random& random);

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_WORLDS_H
