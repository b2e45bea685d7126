// SPDX-License-Identifier: LGPL-3.0-or-later
// Rooms in which the answers for thick edges are known by heart: with a membrane, a step, a channel, a wedge,
// and with single walls far from all others.
#ifndef CELLWALK_TESTS_EDGE_THICK_ROOMS_H
#define CELLWALK_TESTS_EDGE_THICK_ROOMS_H

#include <cellwalk/environment/environment.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "edge/membrane_environment.h"
#include "oracle/squares_and_cubes.h"

namespace cellwalk::test {

template <int D>
Cell_soup<D> stretched(Cell_soup<D> soup, const Vector<D>& factors) {
  for (Point<D>& x : soup.points)
    for (std::size_t k = 0; k < D; ++k) x[k] *= factors[k];
  return soup;
}

/// 4^D cubes of side 2 with a membrane x = 4, 2 <= y, z <= 6, of several facets.
inline Cell_soup<3> membrane_in_cubes() {
  Cell_soup<3> soup = oracle::make_cubes(4, 4, 4);
  for (const std::uint32_t y : {1, 2})
    for (const std::uint32_t z : {1, 2}) {
      const std::uint32_t cell = 1 + 4 * (y + 4 * z);
      oracle::set_wall(soup, cell, cell + 1);
    }
  return stretched<3>(std::move(soup), {2, 2, 2});
}
inline Cell_soup<2> membrane_in_squares() {
  Cell_soup<2> soup = oracle::make_squares(4, 4);
  for (const std::uint32_t y : {1, 2}) oracle::set_wall(soup, 1 + 4 * y, 2 + 4 * y);
  return stretched<2>(std::move(soup), {2, 2});
}

/// A box parted by planes across x; in each of them the square 2 <= y, z <= 6 is a membrane of one facet.
inline Cell_soup<3> membranes_in_box(const Point<3>& low, const Point<3>& high,
                                     const std::vector<double>& planes) {
  Cell_soup<3> soup;
  std::vector<double> x{low[0]};
  x.insert(x.end(), planes.begin(), planes.end());
  x.push_back(high[0]);
  // Of each plane the corners of the box, then those of the membrane, counterclockwise seen from larger x.
  const auto add_square = [&](double at, double y0, double z0, double y1, double z1) {
    for (const auto& [y, z] : {std::array{y0, z0}, {y1, z0}, {y1, z1}, {y0, z1}})
      soup.points.push_back({at, y, z});
  };
  for (const double at : x) {
    add_square(at, low[1], low[2], high[1], high[2]);
    add_square(at, 2, 2, 6, 6);
  }
  const auto add = [&](std::vector<std::uint32_t> loop, bool is_reversed, bool is_wall) {
    if (is_reversed) std::reverse(loop.begin(), loop.end());
    soup.add_facet(loop, is_wall);
  };
  for (std::uint32_t i = 0; i + 1 < x.size(); ++i) {
    for (const std::uint32_t side : {i, i + 1}) {
      const std::uint32_t c = 8 * side, d = c + 4;
      const bool is_low = side == i;
      if (side == 0 || side + 1 == x.size()) {
        add({c, c + 1, c + 2, c + 3}, is_low, true);
        continue;
      }
      add({d, d + 1, d + 2, d + 3}, is_low, true);
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        add({c + k, c + next, d + next, d + k}, is_low, false);
      }
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4, c = 8 * i;
      add({c + k, c + next, c + 8 + next, c + 8 + k}, false, true);
    }
    soup.end_cell();
  }
  return soup;
}

/// The same membrane in a square, of one facet.
inline Cell_soup<2> membrane_in_square() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {4, 0}, {8, 0}, {8, 8}, {4, 8}, {0, 8}, {4, 2}, {4, 6}};
  for (const auto& loop :
       {std::vector<std::uint32_t>{0, 1, 6, 7, 4, 5}, std::vector<std::uint32_t>{1, 2, 3, 4, 7, 6}}) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t v = loop[k], w = loop[(k + 1) % loop.size()];
      soup.add_facet({v, w}, v >= 6 && w >= 6);
    }
    soup.end_cell();
  }
  return soup;
}

/// [0,8]^3 without all that has x > 4 and z < 4.
inline Cell_soup<3> step_in_box() {
  const Cell_soup<3> boxes = oracle::make_cubes(2, 1, 2);
  Cell_soup<3> soup;
  soup.points = boxes.points;
  for (const std::uint32_t c : {0, 2, 3}) {
    for (std::size_t f = boxes.cell_begin[c]; f < boxes.cell_begin[c + 1]; ++f)
      soup.add_facet(boxes.facet(f));
    soup.end_cell();
  }
  return stretched<3>(std::move(soup), {4, 8, 4});
}

/// Between the planes |z| = 3y/4, with walls across x and y far away.
inline Cell_soup<3> wedge() {
  Cell_soup<3> soup;
  for (const double x : {-56., 72.})
    for (const auto& [y, z] : {std::array{0., 0.}, {64., -48.}, {64., 48.}}) soup.points.push_back({x, y, z});
  add_prism(soup, {0, 1, 2, 3, 4, 5});
  return soup;
}

/// A facet in a plane that is not parallel to any axis, with walls far away: pyramids on both sides of it,
/// and tetrahedra round its rim, to outer points beyond its edges.
inline Cell_soup<3> oblique_facet() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0},   {8, 0, 1},   {8, 8, 2},   {0, 8, 1},   {4, -96, 1},
                 {104, 4, 1}, {4, 104, 1}, {-96, 4, 1}, {4, 4, 100}, {4, 4, -100}};
  constexpr std::uint32_t beyond = 4, above = 8, below = 9;
  add_pyramid(soup, {0, 1, 2, 3, above});
  soup.impassable[0] = true;
  add_pyramid(soup, {0, 3, 2, 1, below});
  for (std::uint32_t v = 0; v < 4; ++v) {
    const std::uint32_t next = (v + 1) % 4, last = (v + 3) % 4;
    add_tetrahedron(soup, v, beyond + v, next, above);
    add_tetrahedron(soup, v, next, beyond + v, below);
    add_tetrahedron(soup, v, beyond + last, beyond + v, above);
    add_tetrahedron(soup, v, beyond + v, beyond + last, below);
  }
  return soup;
}

/// Exactly as it is, which the certificate confirms.
template <int D>
Environment<D> room_of(Cell_soup<D> soup) {
  Build_options options;
  options.split = false;
  return Environment<D>::build(std::move(soup), options);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_THICK_ROOMS_H
