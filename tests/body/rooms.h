// SPDX-License-Identifier: LGPL-3.0-or-later
// Rooms of unit cells.
#ifndef CELLWALK_TESTS_BODY_ROOMS_H
#define CELLWALK_TESTS_BODY_ROOMS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::test {

template <int D>
Snapshot<D> compile(const Cell_soup<D>& soup) {
  return Snapshot<D>::compile(soup, glue(soup));
}

/// A grid of unit cells from the origin, with the given solid cells.
template <int D>
Snapshot<D> rooms(std::array<std::uint32_t, D> cells, std::vector<std::uint32_t> solid = {}) {
  Grid_options<D> options;
  options.cells = cells;
  options.solid_cells = std::move(solid);
  if constexpr (D == 2)
    return compile(square_grid(options));
  else
    return compile(hex_grid(options));
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_ROOMS_H
