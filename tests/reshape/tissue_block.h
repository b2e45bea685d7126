// SPDX-License-Identifier: LGPL-3.0-or-later
// Blocks of solid simplices below free ones, which tests cut.
#ifndef CELLWALK_TESTS_RESHAPE_TISSUE_BLOCK_H
#define CELLWALK_TESTS_RESHAPE_TISSUE_BLOCK_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/reshape/cut.h>
#include <cellwalk/walk/locate.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::test {

/// Fills the cells whose corners lie below a height along the last axis, in the mean.
template <int D>
void fill_below(Cell_soup<D>& soup, double height) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = soup.facet_begin[soup.cell_begin[c]]; i < soup.facet_begin[soup.cell_begin[c + 1]];
         ++i) {
      sum += soup.points[soup.vertices[i]][D - 1];
      ++count;
    }
    soup.solid[c] = sum < height * static_cast<double>(count);
  }
}

/// A block of simplices, `size` along each axis, solid below a height.
template <int D>
Environment<D> tissue(std::uint32_t size, double height, double jitter = 0.15, std::uint64_t seed = 1) {
  Simplex_grid_options<D> options;
  options.cells.fill(size);
  options.jitter = jitter;
  options.seed = seed;
  Cell_soup<D> soup;
  if constexpr (D == 2)
    soup = triangle_grid(options);
  else
    soup = tetrahedral_grid(options);
  fill_below(soup, height);
  return Environment<D>::build(std::move(soup));
}

/// The blade of a convex polygon (2D: of a line).
template <int D>
Blade<D> blade(const std::vector<Point<D>>& points) {
  return blade_along<D>(points);
}

/// The solid cells that hang together through facets, part by part.
template <int D>
std::vector<std::vector<Cell>> solid_parts(const Snapshot<D>& snapshot) {
  std::vector<char> is_seen(snapshot.cell_slots(), 0);
  std::vector<std::vector<Cell>> parts;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell first = snapshot.cell(i);
    if (first == Cell::none || !snapshot.is_solid(first) || is_seen[i]) continue;
    std::vector<Cell>& part = parts.emplace_back(1, first);
    is_seen[i] = 1;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (std::size_t f = 0; f < snapshot.facet_count(part[next]); ++f) {
        const Cell other = snapshot.neighbour(Snapshot<D>::half_facet(part[next], f));
        if (other == Cell::none || !snapshot.is_solid(other)) continue;
        if (!std::exchange(is_seen[snapshot.index(other)], 1)) part.push_back(other);
      }
  }
  return parts;
}

/// Random places of free space, in a box from the origin.
template <int D>
std::vector<Point<D>> free_places(const Snapshot<D>& snapshot, std::size_t count, double size) {
  const Locator<D> locator(snapshot);
  Random random(7);
  std::vector<Point<D>> places;
  for (std::size_t tries = 0; places.size() < count && tries < 100 * count; ++tries) {
    Point<D> x;
    for (double& c : x) c = random.real(0, size);
    if (locator.locate(x).status == Location_status::free) places.push_back(x);
  }
  return places;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_TISSUE_BLOCK_H
