// SPDX-License-Identifier: LGPL-3.0-or-later
// Cell soups that the tests of maps and environments share: one of each kind that has broken something
// elsewhere.
#ifndef CELLWALK_TESTS_ENVIRONMENT_SAMPLE_SOUPS_H
#define CELLWALK_TESTS_ENVIRONMENT_SAMPLE_SOUPS_H

#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::test {

template <int D>
using Named_soup = std::pair<std::string, Cell_soup<D>>;

/// Two cubes (squares) that touch in one vertex only.
inline Cell_soup<2> pinched_squares() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
  add_polygon(soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  add_polygon(soup, std::array<std::uint32_t, 4>{2, 4, 5, 6});
  return soup;
}

/// Tetrahedra a, b that touch in one vertex, and c that touches b in one edge.
inline Cell_soup<3> pinched_tetrahedra() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},   {0, 0, 1},  {-1, 0, 0},
                 {0, -1, 0}, {0, 0, -1}, {-2, 0, -1}, {-1, 1, -1}};
  add_tetrahedron(soup, 0, 1, 2, 3);
  add_tetrahedron(soup, 0, 5, 4, 6);
  add_tetrahedron(soup, 4, 6, 7, 8);
  return soup;
}

/// A pentagon with a vertex in the middle of a side, beside two squares that share that side.
inline Cell_soup<2> collinear_polygon() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}, {3, 0}, {3, 1}, {3, 2}};
  add_polygon(soup, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  add_polygon(soup, std::array<std::uint32_t, 4>{1, 5, 6, 2});
  add_polygon(soup, std::array<std::uint32_t, 4>{2, 6, 7, 3});
  return soup;
}

/// A prism over a polygon with 70 sides: more edges than the linear searches of small cells take.
inline Cell_soup<3> round_prism() {
  Cell_soup<3> soup;
  constexpr std::uint32_t n = 70;
  std::vector<std::uint32_t> top, bottom;
  for (std::uint32_t i = 0; i < n; ++i) {
    // Points of a parabola are in convex position, exactly.
    const double x = static_cast<double>(i) - n / 2;
    soup.points.push_back({x, x * x, 0});
    soup.points.push_back({x, x * x, 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  soup.add_facet(bottom);
  soup.add_facet(top);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    soup.add_facet({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  soup.end_cell();
  return soup;
}

/// Everything above, grids, and lattice worlds with membranes, solid and missing cells, coplanar facets of
/// one cell, cells that share several facets, facets with collinear vertices.
template <int D>
std::vector<Named_soup<D>> sample_soups() {
  std::vector<Named_soup<D>> result;
  if constexpr (D == 2) {
    result.emplace_back("pinched", pinched_squares());
    result.emplace_back("collinear", collinear_polygon());
    result.emplace_back("grid", triangle_grid({.cells = {4, 3}, .jitter = 0.1}));
  } else {
    result.emplace_back("pinched", pinched_tetrahedra());
    result.emplace_back("round", round_prism());
    result.emplace_back("grid", tetrahedral_grid({.cells = {3, 4, 2}, .jitter = 0.1}));
  }
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    Lattice_world_options<D> options = mixed_lattice_world<D>(seed);
    if (D == 2) options.cells = Grid_options<D>::filled(12);
    result.emplace_back("world " + std::to_string(seed), lattice_world(options));
  }
  return result;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_SAMPLE_SOUPS_H
