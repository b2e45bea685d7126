// SPDX-License-Identifier: LGPL-3.0-or-later
#include "spike_room.h"

#include <array>
#include <cmath>

namespace cellwalk::small_obstacles {
namespace {

using Ring = std::array<std::uint32_t, 4>;  // counterclockwise seen from above

/// Corners of a square about the z axis, at a height.
Ring add_square(Cell_soup<3>& soup, double half_width, double z) {
  const double w = half_width;
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const Point<3>& x : {Point<3>{w, w, z}, {-w, w, z}, {-w, -w, z}, {w, -w, z}}) soup.points.push_back(x);
  return {first, first + 1, first + 2, first + 3};
}

Environment<3> build(Cell_soup<3> soup) {
  Build_options options;
  options.split = false;
  options.keep_map = false;
  return Environment<3>::build(std::move(soup), options);
}

/// cos and sin of multiples of an eighth of pi, by square roots: the same with every library.
std::array<std::array<double, 2>, spike_sides> unit_polygon() {
  const double half = std::sqrt(0.5), c = std::sqrt((1 + half) / 2), s = std::sqrt((1 - half) / 2);
  std::array<std::array<double, 2>, spike_sides> corners;
  const std::array<std::array<double, 2>, 4> quarter{{{1, 0}, {c, s}, {half, half}, {s, c}}};
  for (std::size_t k = 0; k < spike_sides; ++k) {
    auto [x, y] = quarter[k % 4];
    for (std::size_t turn = 0; turn < k / 4; ++turn) {
      const double old = x;
      x = -y;
      y = old;
    }
    corners[k] = {x, y};
  }
  return corners;
}

}  // namespace

double inner_radius(const Spike& spike) {
  const double cosine = std::sqrt((1 + std::sqrt(0.5)) / 2);  // of pi / 8
  return spike.radius * std::sqrt((1 + cosine) / 2);
}

Environment<3> spike_room(const Room& room, const Spike& spike) {
  Cell_soup<3> soup;
  const Ring below = add_square(soup, room.half_width, 0),
             above = add_square(soup, room.half_width, room.height);
  const auto tip = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back({0, 0, spike.height});
  std::array<std::uint32_t, spike_sides> base;
  for (std::size_t k = 0; const auto& [x, y] : unit_polygon()) {
    base[k++] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back({spike.radius * x, spike.radius * y, 0});
  }
  const auto corner = [&](std::size_t k) { return base[k % spike_sides]; };

  std::array<std::uint32_t, spike_sides> from_below;
  for (std::size_t k = 0; k < spike_sides; ++k) from_below[k] = base[spike_sides - 1 - k];
  soup.add_facet(from_below);
  for (std::size_t k = 0; k < spike_sides; ++k) soup.add_facet({corner(k), corner(k + 1), tip});
  soup.end_cell(true);

  // The floor round the base: corner j of the room sees the quarter of the base that is turned to it.
  for (std::size_t j = 0; j < 4; ++j) {
    const std::size_t next = (j + 1) % 4;
    for (std::size_t k = 4 * j; k < 4 * j + 4; ++k)
      add_tetrahedron(soup, corner(k), below[j], corner(k + 1), tip);
    add_tetrahedron(soup, below[j], below[next], corner(4 * j + 4), tip);
    add_pyramid(soup, {below[next], below[j], above[j], above[next], tip});
  }
  add_pyramid(soup, {above[0], above[3], above[2], above[1], tip});
  return build(std::move(soup));
}

Environment<3> floating_room(const Room& room, double side) {
  Cell_soup<3> soup;
  const double low = room.height / 2 - side / 2;
  const std::array<Ring, 2> outer{add_square(soup, room.half_width, 0),
                                  add_square(soup, room.half_width, room.height)},
      inner{add_square(soup, side / 2, low), add_square(soup, side / 2, low + side)};
  const auto add = [&](const Ring& down, const Ring& up) {
    add_hexahedron(soup, {down[0], down[1], down[2], down[3], up[0], up[1], up[2], up[3]});
  };
  add(inner[0], inner[1]);
  soup.solid.back() = 1;
  add(outer[0], inner[0]);
  add(inner[1], outer[1]);
  for (std::size_t j = 0; j < 4; ++j) {
    const std::size_t next = (j + 1) % 4;
    add({outer[0][j], outer[0][next], inner[0][next], inner[0][j]},
        {outer[1][j], outer[1][next], inner[1][next], inner[1][j]});
  }
  return build(std::move(soup));
}

}  // namespace cellwalk::small_obstacles
