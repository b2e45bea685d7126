// SPDX-License-Identifier: LGPL-3.0-or-later
// Regular grids: the paper's scene of hexahedra with solid cells (its figure 7), and simplicial grids for
// benchmarks. Cell (ix,iy,iz) has index ix + nx (iy + ny iz), point (ix,iy,iz) index ix + (nx+1) (iy + (ny+1)
// iz).
#ifndef CELLWALK_GENERATORS_GRID_H
#define CELLWALK_GENERATORS_GRID_H

#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// A grid of hexahedra or squares, some of them solid.
template <int D>
struct Grid_options {
  std::array<std::uint32_t, D> cells = filled(10);  ///< cells along each axis
  double solid_share = 0;                    ///< fraction of solid cells, which do not touch each other
  std::uint64_t seed = 1;                    ///< selects them
  std::vector<std::uint32_t> solid_cells{};  ///< or exactly these, which may touch
  Lattice_map<D> map{};                      ///< by default unit cells

  static constexpr std::array<std::uint32_t, D> filled(std::uint32_t n) {
    std::array<std::uint32_t, D> a{};
    a.fill(n);
    return a;
  }
};

/// A grid of hexahedra. Solid cells are kept, marked solid, and their facets are impassable. With
/// `solid_share` the solid cells are drawn one by one at random from those that touch none drawn before. If
/// this gets stuck (above about 8 % in 3D, 18 % in 2D), they are drawn on separate random layers and rows,
/// which reaches the maximum of one in 2^D cells if all dimensions are even. Paper: section IV, figure 7.
/// \throw Error(usage) if a dimension is 0, the grid is too large for 32-bit indices, the share cannot be
///        reached (with the largest possible one), a solid cell is out of range, share and list are both
///        given, or the map rounds
/// Cost: about 0.2 us a cell.
Cell_soup<3> hex_grid(const Grid_options<3>& options);

/// A grid of squares; see hex_grid.
Cell_soup<2> square_grid(const Grid_options<2>& options);

/// A grid whose cubes are split into simplices.
template <int D>
struct Simplex_grid_options {
  std::array<std::uint32_t, D> cells = Grid_options<D>::filled(10);  ///< cubes along each axis
  double jitter = 0;       ///< each point moves by up to this much along each axis, in cells; at most 0.15
  std::uint64_t seed = 1;  ///< of the jitter
  Lattice_map<D> map{};
};

/// A conforming grid of tetrahedra, six to a cube (Kuhn: all along the diagonal from the lowest to the
/// highest corner). Tetrahedron t of cube c has index 6 c + t. With jitter the points are in general
/// position.
/// \throw Error(usage) as hex_grid(), or if the jitter is out of range
/// Cost: about 0.1 us a tetrahedron.
Cell_soup<3> tetrahedral_grid(const Simplex_grid_options<3>& options);

/// A conforming grid of triangles, two to a square.
Cell_soup<2> triangle_grid(const Simplex_grid_options<2>& options);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_GRID_H
