// SPDX-License-Identifier: LGPL-3.0-or-later
#include "box_world.h"

#include <cellwalk/internal/kernel/random.h>

#include <array>

namespace cellwalk::small_obstacles {
namespace {

/// The corners of a box: bit k of the place says on which side of axis k.
template <int D>
using Corners = std::array<std::uint32_t, std::size_t{1} << D>;

void add_cell(Cell_soup<2>& soup, const Corners<2>& v) {
  add_polygon(soup, std::array<std::uint32_t, 4>{v[0], v[1], v[3], v[2]});
}

void add_cell(Cell_soup<3>& soup, const Corners<3>& v) {
  add_hexahedron(soup, {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
}

/// The box, then the frustum on each side.
template <int D>
void add_cube(Cell_soup<D>& soup, const Corners<D>& outer, const Corners<D>& inner) {
  add_cell(soup, inner);
  soup.solid.back() = 1;
  for (std::size_t axis = 0; axis < D; ++axis)
    for (const bool high : {false, true}) {
      const std::size_t bit = std::size_t{1} << axis;
      Corners<D> v;
      for (std::size_t c = 0; c < v.size(); ++c) v[c] = ((c & bit) != 0) == high ? outer[c] : inner[c ^ bit];
      add_cell(soup, v);
    }
}

}  // namespace

template <int D>
Environment<D> box_world(const Box_world_options<D>& options) {
  const std::uint32_t n = options.cubes;
  Random random(options.seed);
  Cell_soup<D> soup;
  std::array<std::uint32_t, D> at{};
  // Counts up to `end` along each axis, the first one first.
  const auto next = [&at](std::uint32_t end) {
    for (std::uint32_t& x : at) {
      if (++x < end) return true;
      x = 0;
    }
    return false;
  };
  do {
    Point<D> x{};
    for (std::size_t k = 0; k < D; ++k) x[k] = at[k];
    soup.points.push_back(x);
  } while (next(n + 1));
  do {
    Corners<D> outer, inner;
    std::array<std::array<double, 2>, D> limits;
    for (std::size_t k = 0; k < D; ++k) {
      const double low = at[k] + random.real(box_margin, 1 - box_margin - options.side);
      limits[k] = {low, low + options.side};
    }
    for (std::size_t c = 0; c < outer.size(); ++c) {
      Point<D> x{};
      std::uint32_t index = 0;
      for (std::size_t k = D; k-- > 0;) {
        const std::uint32_t side = (c >> k) & 1;
        x[k] = limits[k][side];
        index = index * (n + 1) + at[k] + side;
      }
      outer[c] = index;
      inner[c] = static_cast<std::uint32_t>(soup.points.size());
      soup.points.push_back(x);
    }
    add_cube<D>(soup, outer, inner);
  } while (next(n));
  Build_options build;
  build.split = false;
  build.keep_map = false;
  return Environment<D>::build(std::move(soup), build);
}

template Environment<2> box_world<2>(const Box_world_options<2>&);
template Environment<3> box_world<3>(const Box_world_options<3>&);

}  // namespace cellwalk::small_obstacles
