// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/membrane_environment.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cellwalk::test {
namespace {

/// Distance of the outer vertices in units of the half size of the scene's box.
constexpr double distance_of_walls = 64;
constexpr double third_of_turn = 2 * std::numbers::pi / 3;

Vector<3> unit(const Vector<3>& v) {
  double largest = 0;  // so that squares of tiny lengths do not vanish
  for (double x : v) largest = std::max(largest, std::abs(x));
  return normalized((1 / largest) * v);
}

/// The directions of the outer vertices beyond the edges of the triangle.
std::array<Vector<3>, 3> directions_beyond_edges(const std::array<Point<3>, 3>& t, const Vector<3>& n) {
  std::array<Vector<3>, 3> outward;
  for (std::size_t i = 0; i < 3; ++i) outward[i] = unit(cross(unit(t[(i + 1) % 3] - t[i]), n));
  // How far each outward normal is ahead of directions at thirds of a turn.
  std::array<double, 3> ahead{0, 0, 0};
  double turn = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    turn += std::atan2(length(cross(outward[i - 1], outward[i])), dot(outward[i - 1], outward[i]));
    ahead[i] = turn - static_cast<double>(i) * third_of_turn;
  }
  const auto [least, most] = std::minmax_element(ahead.begin(), ahead.end());
  const double middle = (*least + *most) / 2;
  const Vector<3> left = cross(n, outward[0]);
  std::array<Vector<3>, 3> directions;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = middle + static_cast<double>(i) * third_of_turn;
    directions[i] = std::cos(angle) * outward[0] + std::sin(angle) * left;
  }
  return directions;
}

}  // namespace

Environment<3> membrane_environment(const std::array<Point<3>, 3>& t, std::span<const Point<3>> inside,
                                    Build_report* report) {
  const Vector<3> n = unit_normal(t[0], t[1], t[2]);
  if (are_collinear(t[0], t[1], t[2]))
    throw std::invalid_argument("a membrane needs a triangle: its points lie on one line");
  Point<3> low = t[0], high = t[0];
  const auto add = [&](const Point<3>& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  };
  for (const Point<3>& p : t) add(p);
  for (const Point<3>& p : inside) add(p);
  const Point<3> centre = low + 0.5 * (high - low);
  double half_size = 0;
  for (std::size_t i = 0; i < 3; ++i) half_size = std::max(half_size, (high[i] - low[i]) / 2);
  const double far = distance_of_walls * half_size;

  Cell_soup<3> soup;
  soup.points = {t[0], t[1], t[2], centre + far * n, centre + (-far) * n};
  for (const Vector<3>& d : directions_beyond_edges(t, n)) soup.points.push_back(centre + far * d);
  constexpr std::uint32_t above = 3, below = 4, beyond = 5;
  add_tetrahedron(soup, 0, 1, 2, above);
  soup.impassable[0] = true;
  add_tetrahedron(soup, 0, 2, 1, below);
  for (std::uint32_t v = 0; v < 3; ++v) {
    const std::uint32_t next = (v + 1) % 3, last = (v + 2) % 3;
    add_tetrahedron(soup, v, beyond + v, next, above);
    add_tetrahedron(soup, v, next, beyond + v, below);
    add_tetrahedron(soup, v, beyond + last, beyond + v, above);
    add_tetrahedron(soup, v, beyond + v, beyond + last, below);
  }
  Build_options options;
  options.split = false;
  return Environment<3>::build(std::move(soup), options, report);
}

}  // namespace cellwalk::test
