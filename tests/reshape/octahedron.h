// SPDX-License-Identifier: LGPL-3.0-or-later
// The star of one vertex, point 0 in the origin, made of a tetrahedron in each octant.
#ifndef CELLWALK_TESTS_RESHAPE_OCTAHEDRON_H
#define CELLWALK_TESTS_RESHAPE_OCTAHEDRON_H

#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>

namespace cellwalk::test {

/// Points 1 and 2 are (16,0,0) and (-16,0,0), 3 and 4 the same along y, 5 and 6 along z.
/// \param walls the corners of its walls
inline Cell_soup<3> octahedron(std::initializer_list<std::array<std::uint32_t, 3>> walls) {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {16, 0, 0}, {-16, 0, 0}, {0, 16, 0}, {0, -16, 0}, {0, 0, 16}, {0, 0, -16}};
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    std::uint32_t a = 1 + (octant & 1), b = 3 + (octant >> 1 & 1);
    const std::uint32_t c = 5 + (octant >> 2);
    if (((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0) std::swap(a, b);
    add_tetrahedron(soup, 0, a, b, c);
  }
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    for (const auto& wall : walls)
      if (std::ranges::is_permutation(soup.facet(f), wall)) soup.impassable[f] = 1;
  return soup;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_OCTAHEDRON_H
