// SPDX-License-Identifier: LGPL-3.0-or-later
// Lattices with membranes, and points at which much lies in planes and lines of them.
#ifndef CELLWALK_TESTS_EDGE_MEMBRANE_LATTICE_H
#define CELLWALK_TESTS_EDGE_MEMBRANE_LATTICE_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "oracle/exact_world.h"
#include "oracle/squares_and_cubes.h"

namespace cellwalk::test {

/// 4 x 3 squares, or 3 x 2 x 2 cubes.
template <int D>
class Membrane_lattice {
 public:
  static Cell_soup<D> soup(Random& random) {
    Cell_soup<D> soup;
    if constexpr (D == 2)
      soup = oracle::make_squares(4, 3);
    else
      soup = oracle::make_cubes(3, 2, 2);
    const oracle::Facet_table table = oracle::make_facet_table(soup);
    const double share = random.real(0.1, 0.5);
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
      const auto other = table.opposite[f];
      if (other < static_cast<std::int64_t>(f) || !random.chance(share)) continue;
      soup.impassable[f] = soup.impassable[static_cast<std::size_t>(other)] = 1;
    }
    return soup;
  }

  /// A multiple of 1/2, half of them integers.
  static Point<D> point(Random& random) {
    Point<D> x{};
    for (std::size_t k = 0; k < D; ++k) {
      const double step = random.chance(0.5) ? 1 : 0.5;
      x[k] = step * std::floor(random.real(0, size[k] + step) / step);
      x[k] = std::min(x[k], size[k]);
    }
    return x;
  }

  /// Another point, mostly on a line or plane of facets through this one.
  static Point<D> near(const Point<D>& from, Random& random) {
    Point<D> x = point(random);
    if (random.chance(0.3)) return x;
    const std::size_t axis = random.below(D);
    const bool is_on_line = D == 2 || random.chance(0.5);
    for (std::size_t k = 0; k < D; ++k)
      if (is_on_line ? k != axis : k == axis) x[k] = from[k];
    return x;
  }

 private:
  static constexpr std::array<double, 3> size =
      D == 2 ? std::array<double, 3>{4, 3, 0} : std::array<double, 3>{3, 2, 2};
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_MEMBRANE_LATTICE_H
