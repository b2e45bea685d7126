// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds small enough to know the answers by heart: grids of unit squares and cubes with walls put in by
// hand.
#ifndef CELLWALK_TESTS_ORACLE_SQUARES_AND_CUBES_H
#define CELLWALK_TESTS_ORACLE_SQUARES_AND_CUBES_H

#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace cellwalk::oracle {

/// nx * ny unit squares from the origin on; square (x,y) has the index x + nx y. All inner edges passable.
inline Cell_soup<2> make_squares(std::uint32_t nx, std::uint32_t ny) {
  Cell_soup<2> soup;
  for (std::uint32_t y = 0; y <= ny; ++y)
    for (std::uint32_t x = 0; x <= nx; ++x) soup.points.push_back({double(x), double(y)});
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return x + (nx + 1) * y; };
  for (std::uint32_t y = 0; y < ny; ++y)
    for (std::uint32_t x = 0; x < nx; ++x) {
      const std::uint32_t loop[] = {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
      add_polygon(soup, loop);
    }
  return soup;
}

/// nx * ny * nz unit cubes; cube (x,y,z) has the index x + nx (y + ny z). All inner facets passable.
inline Cell_soup<3> make_cubes(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
  Cell_soup<3> soup;
  for (std::uint32_t z = 0; z <= nz; ++z)
    for (std::uint32_t y = 0; y <= ny; ++y)
      for (std::uint32_t x = 0; x <= nx; ++x) soup.points.push_back({double(x), double(y), double(z)});
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return x + (nx + 1) * (y + (ny + 1) * z);
  };
  for (std::uint32_t z = 0; z < nz; ++z)
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x)
        add_hexahedron(soup,
                       {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z), at(x, y, z + 1),
                        at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)});
  return soup;
}

/// Makes the facets that two cells share impassable.
template <int D>
void set_wall(Cell_soup<D>& soup, std::uint32_t a, std::uint32_t b) {
  int found = 0;
  for (std::size_t f = soup.cell_begin[a]; f < soup.cell_begin[a + 1]; ++f)
    for (std::size_t g = soup.cell_begin[b]; g < soup.cell_begin[b + 1]; ++g) {
      const std::set<std::uint32_t> u(soup.facet(f).begin(), soup.facet(f).end());
      const std::set<std::uint32_t> v(soup.facet(g).begin(), soup.facet(g).end());
      if (u != v) continue;
      soup.impassable[f] = soup.impassable[g] = 1;
      ++found;
    }
  if (found == 0) throw std::logic_error("cells without a common facet");
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_SQUARES_AND_CUBES_H
