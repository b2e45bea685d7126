// SPDX-License-Identifier: LGPL-3.0-or-later
// Grids of simplices with unit cubes, and membranes across them.
#ifndef CELLWALK_TESTS_RESHAPE_GRIDS_H
#define CELLWALK_TESTS_RESHAPE_GRIDS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>

#include <algorithm>
#include <cstdint>

namespace cellwalk::test {

template <int D>
Environment<D> simplex_grid(std::uint32_t cells, const Build_options& options = {}) {
  Simplex_grid_options<D> grid;
  grid.cells.fill(cells);
  if constexpr (D == 2)
    return Environment<D>::build(triangle_grid(grid), options);
  else
    return Environment<D>::build(tetrahedral_grid(grid), options);
}

/// Makes all facets in the plane through a height on the last axis impassable.
template <int D>
void add_membrane(Environment<D>& environment, double height) {
  const Snapshot<D>& snapshot = environment.snapshot();
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(snapshot.cell(i), k);
      const auto loop = snapshot.loop(f);
      if (std::all_of(loop.begin(), loop.end(),
                      [&](std::uint32_t v) { return snapshot.point(v)[D - 1] == height; }))
        environment.set_impassable(f, true);
    }
}

template <int D>
std::uint32_t point_at(const Environment<D>& environment, const Point<D>& x) {
  const auto points = environment.snapshot().points();
  return static_cast<std::uint32_t>(std::find(points.begin(), points.end(), x) - points.begin());
}

/// The mean of the corners of a cell, rounded.
template <int D>
Point<D> middle_of(const Snapshot<D>& snapshot, Cell cell) {
  const Cell_view<D> view = snapshot.view(cell);
  Point<D> sum{};
  for (std::size_t v = 0; v < view.vertex_count(); ++v) sum = sum + view.point(v);
  return (1 / static_cast<double>(view.vertex_count())) * sum;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_GRIDS_H
