// SPDX-License-Identifier: LGPL-3.0-or-later
// Points with jitter, solid cells apart, and cubes cut into simplices.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/placement.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "apart.h"

namespace cellwalk {
namespace {

/// Checks that a grid's points and half-facet vertices can be counted in 32 bits.
template <int D>
void check_size(const std::array<std::uint32_t, D>& cells, double vertices_per_cell) {
  double total = vertices_per_cell;
  for (std::uint32_t n : cells) {
    if (n == 0)
      throw Error(Error_code::usage, "grid: a dimension is 0; give at least 1 cell along each axis");
    total *= n + 1.0;
  }
  if (total >= 0x1p32) throw Error(Error_code::usage, "grid: too large for 32-bit indices; give fewer cells");
}

template <int D>
std::uint64_t count_of(const std::array<std::uint32_t, D>& cells) {
  std::uint64_t total = 1;
  for (std::uint32_t n : cells) total *= n;
  return total;
}

/// The lattice points in index order, each moved by up to `jitter`.
template <int D>
std::vector<Point<D>> lattice_points(const std::array<std::uint32_t, D>& cells, const Lattice_map<D>& map,
                                     double jitter, Random& random) {
  std::uint64_t total = 1;
  for (std::uint32_t n : cells) total *= n + 1;
  std::vector<Point<D>> points(total);
  std::array<std::uint32_t, D> k{};
  for (auto& p : points) {
    Point<D> x;
    for (int a = 0; a < D; ++a) x[a] = k[a];
    if (jitter > 0)
      for (double& coordinate : x) coordinate += random.real(-jitter, jitter);
    p = map(x);
    for (int a = 0; a < D && k[a]++ == cells[a]; ++a) k[a] = 0;
  }
  return points;
}

template <int D>
std::vector<std::uint32_t> solid_cells(const Grid_options<D>& options) {
  const std::uint64_t total = count_of<D>(options.cells);
  if (!options.solid_cells.empty()) {
    if (options.solid_share != 0)
      throw Error(Error_code::usage,
                  "grid: both a share and a list of solid cells are given; give one of them");
    for (std::uint32_t cell : options.solid_cells)
      if (cell >= total)
        throw Error(Error_code::usage, "grid: solid cell " + std::to_string(cell) + " is not one of the " +
                                           std::to_string(total) + " cells");
    return options.solid_cells;
  }
  const double share = options.solid_share;
  if (!(share >= 0 && share <= 1))
    throw Error(Error_code::usage, "grid: the share of solid cells must lie in [0,1]");
  const auto count = static_cast<std::uint64_t>(std::floor(share * static_cast<double>(total) + 0.5));
  const std::uint64_t most = detail::most_cells_apart<D>(options.cells);
  if (count > most)
    throw Error(Error_code::usage,
                "grid: " + std::to_string(count) + " solid cells cannot lie apart; at most " +
                    std::to_string(most) + " of " + std::to_string(total) + " can (share " +
                    std::to_string(static_cast<double>(most) / static_cast<double>(total)) + ")");
  Random random(options.seed);
  return detail::cells_apart<D>(options.cells, count, random);
}

template <int D>
void mark_solid(Cell_soup<D>& soup, const std::vector<std::uint32_t>& cells) {
  for (std::uint32_t cell : cells) {
    soup.solid[cell] = 1;
    for (std::uint32_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) soup.impassable[f] = 1;
  }
}

template <int D>
void reserve(Cell_soup<D>& soup, std::size_t cells, std::size_t facets, std::size_t facet_vertices) {
  soup.cell_begin.reserve(cells + 1);
  soup.solid.reserve(cells);
  soup.facet_begin.reserve(cells * facets + 1);
  soup.impassable.reserve(cells * facets);
  soup.vertices.reserve(cells * facets * facet_vertices);
}

template <int D>
void check_jitter(const Simplex_grid_options<D>& options) {
  // Two ends of a lattice edge move by less than 2 * 0.15, so the edge vectors of a simplex, in the order of
  // its axes, form a matrix that is strictly diagonally dominant (1 - 0.3 > 2 * 0.3): it stays positive.
  if (!(options.jitter >= 0 && options.jitter <= 0.15))
    throw Error(Error_code::usage, "grid: the jitter must lie in [0,0.15], so that cells stay positive");
}

}  // namespace

Cell_soup<3> hex_grid(const Grid_options<3>& options) {
  check_size<3>(options.cells, 24);
  check_placement<3>(options.map, options.cells, 0, Placement::planar);
  const auto solid = solid_cells<3>(options);
  const auto [nx, ny, nz] = options.cells;
  Random random(options.seed);
  Cell_soup<3> soup;
  soup.points = lattice_points<3>(options.cells, options.map, 0, random);
  reserve(soup, count_of<3>(options.cells), 6, 4);
  const std::uint32_t y = nx + 1, z = (nx + 1) * (ny + 1);
  for (std::uint32_t iz = 0; iz < nz; ++iz)
    for (std::uint32_t iy = 0; iy < ny; ++iy)
      for (std::uint32_t ix = 0; ix < nx; ++ix) {
        const std::uint32_t o = ix + y * iy + z * iz;
        add_hexahedron(soup, {o, o + 1, o + 1 + y, o + y, o + z, o + z + 1, o + z + 1 + y, o + z + y});
      }
  mark_solid(soup, solid);
  return soup;
}

Cell_soup<2> square_grid(const Grid_options<2>& options) {
  check_size<2>(options.cells, 8);
  check_placement<2>(options.map, options.cells, 0, Placement::planar);
  const auto solid = solid_cells<2>(options);
  const auto [nx, ny] = options.cells;
  Random random(options.seed);
  Cell_soup<2> soup;
  soup.points = lattice_points<2>(options.cells, options.map, 0, random);
  reserve(soup, count_of<2>(options.cells), 4, 2);
  const std::uint32_t y = nx + 1;
  for (std::uint32_t iy = 0; iy < ny; ++iy)
    for (std::uint32_t ix = 0; ix < nx; ++ix) {
      const std::uint32_t o = ix + y * iy;
      add_polygon(soup, std::array{o, o + 1, o + 1 + y, o + y});
    }
  mark_solid(soup, solid);
  return soup;
}

Cell_soup<3> tetrahedral_grid(const Simplex_grid_options<3>& options) {
  check_size<3>(options.cells, 72);
  check_jitter(options);
  check_placement<3>(options.map, options.cells, 0, Placement::positive);
  const auto [nx, ny, nz] = options.cells;
  Random random(options.seed);
  Cell_soup<3> soup;
  soup.points = lattice_points<3>(options.cells, options.map, options.jitter, random);
  reserve(soup, 6 * count_of<3>(options.cells), 4, 3);
  const std::uint32_t x = 1, y = nx + 1, z = (nx + 1) * (ny + 1), top = x + y + z;
  for (std::uint32_t iz = 0; iz < nz; ++iz)
    for (std::uint32_t iy = 0; iy < ny; ++iy)
      for (std::uint32_t ix = 0; ix < nx; ++ix) {
        // One tetrahedron for each order of the axes on the path from the lowest to the highest corner.
        const std::uint32_t o = ix + y * iy + z * iz;
        add_tetrahedron(soup, o, o + x, o + x + y, o + top);
        add_tetrahedron(soup, o, o + y, o + y + z, o + top);
        add_tetrahedron(soup, o, o + z, o + z + x, o + top);
        add_tetrahedron(soup, o, o + x + y, o + y, o + top);
        add_tetrahedron(soup, o, o + y + z, o + z, o + top);
        add_tetrahedron(soup, o, o + z + x, o + x, o + top);
      }
  return soup;
}

Cell_soup<2> triangle_grid(const Simplex_grid_options<2>& options) {
  check_size<2>(options.cells, 12);
  check_jitter(options);
  check_placement<2>(options.map, options.cells, 0, Placement::positive);
  const auto [nx, ny] = options.cells;
  Random random(options.seed);
  Cell_soup<2> soup;
  soup.points = lattice_points<2>(options.cells, options.map, options.jitter, random);
  reserve(soup, 2 * count_of<2>(options.cells), 3, 2);
  const std::uint32_t y = nx + 1;
  for (std::uint32_t iy = 0; iy < ny; ++iy)
    for (std::uint32_t ix = 0; ix < nx; ++ix) {
      const std::uint32_t o = ix + y * iy;
      add_polygon(soup, std::array{o, o + 1, o + 1 + y});
      add_polygon(soup, std::array{o, o + 1 + y, o + y});
    }
  return soup;
}

}  // namespace cellwalk
