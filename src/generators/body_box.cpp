// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes and the hexahedron, which is the box of one cell along each axis.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "quad_rotation.h"

namespace cellwalk {
namespace {

using detail::nearest;
using detail::Quad;

void check(const Vector<3>& size, const std::array<std::uint32_t, 3>& cells) {
  double all = 1, inner = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(size[k] > 0) || !std::isfinite(size[k]))
      throw Error(Error_code::usage, fmt::format("box: its size must be positive numbers, not {}", size[k]));
    if (cells[k] == 0)
      throw Error(Error_code::usage, "box: no cells along an axis; give at least 1 along each");
    all *= cells[k] + 1.0;
    inner *= cells[k] - 1.0;
  }
  if (all - inner > most_generated_vertices)
    throw Error(Error_code::usage, fmt::format("box: {} vertices; give fewer cells, for at most {}",
                                               all - inner, most_generated_vertices));
}

/// The points of the lattice on the surface, numbered.
class Lattice {
 public:
  Lattice(const Vector<3>& size, const std::array<std::uint32_t, 3>& cells) : cells_(cells) {
    std::array<std::vector<double>, 3> coordinates;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::uint32_t i = 0; i <= cells_[k]; ++i)
        coordinates[k].push_back(nearest(Quad(size[k]) * (2.0 * i - cells_[k]) / (2.0 * cells_[k])));
    std::array<std::uint32_t, 3> i{};
    for (i[2] = 0; i[2] <= cells_[2]; ++i[2])
      for (i[1] = 0; i[1] <= cells_[1]; ++i[1]) {
        const bool rim = i[1] == 0 || i[1] == cells_[1] || i[2] == 0 || i[2] == cells_[2];
        for (i[0] = 0; i[0] <= cells_[0]; i[0] += rim ? 1 : cells_[0]) {
          index_.emplace(key(i), static_cast<std::uint32_t>(points.size()));
          points.push_back({coordinates[0][i[0]], coordinates[1][i[1]], coordinates[2][i[2]]});
        }
      }
  }

  std::uint32_t operator()(const std::array<std::uint32_t, 3>& i) const { return index_.at(key(i)); }

  std::vector<Point<3>> points;

 private:
  std::uint64_t key(const std::array<std::uint32_t, 3>& i) const {
    return i[0] + (cells_[0] + std::uint64_t{1}) * (i[1] + (cells_[1] + std::uint64_t{1}) * i[2]);
  }

  std::array<std::uint32_t, 3> cells_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_;
};

}  // namespace

Body_soup<3> box_body(const Vector<3>& size, const std::array<std::uint32_t, 3>& cells, bool faces) {
  check(size, cells);
  Lattice lattice(size, cells);
  Body_parts<3> parts;
  // A rectangle at (i, j) of a side, counterclockwise seen from outside.
  const auto add = [&](std::size_t axis, bool high, std::uint32_t i, std::uint32_t j) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto corner = [&](std::uint32_t a, std::uint32_t b) {
      std::array<std::uint32_t, 3> at{};
      at[axis] = high ? cells[axis] : 0;
      at[high ? u : v] = (high ? i : j) + a;
      at[high ? v : u] = (high ? j : i) + b;
      return lattice(at);
    };
    const std::array<std::uint32_t, 4> loop{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (faces)
      parts.polygons.emplace_back(loop.begin(), loop.end());
    else
      for (std::size_t k = 0; k < 4; ++k) parts.segments.push_back({loop[k], loop[(k + 1) % 4]});
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true})
      for (std::uint32_t j = 0; j < cells[(axis + 2) % 3]; ++j)
        for (std::uint32_t i = 0; i < cells[(axis + 1) % 3]; ++i) add(axis, high, i, j);
  parts.points = std::move(lattice.points);
  return make_body<3>(std::move(parts)).body;
}

Body_soup<3> hexahedron_body(double side, bool faces) {
  if (!(side > 0) || !std::isfinite(side))
    throw Error(Error_code::usage,
                fmt::format("hexahedron: the side must be a positive number, not {}", side));
  return box_body({side, side, side}, {1, 1, 1}, faces);
}

}  // namespace cellwalk
