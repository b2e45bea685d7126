// SPDX-License-Identifier: LGPL-3.0-or-later
#include "half_space.h"

namespace cellwalk::detail {
namespace {

template <int D>
Half_space<D> opposite(const Half_space<D>& h) {
  Half_space<D> other = h;
  for (Rational& x : other.normal) x = -x;
  return other;
}

}  // namespace

std::vector<Half_space<2>> half_spaces(const Cell_view<2>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const auto u = exact<2>(cell.point(loop[0])), v = exact<2>(cell.point(loop[1]));
  const auto e = minus(v, u);
  const Half_space<2> line{u, {-e[1], e[0]}};
  return {line, opposite(line), {u, e}, {v, minus(u, v)}};
}

std::vector<Half_space<3>> half_spaces(const Cell_view<3>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  std::vector<Rational_point<3>> points;
  for (const std::uint16_t v : loop) points.push_back(exact<3>(cell.point(v)));
  const Half_space<3> plane{points[0], exact_cross(minus(points[1], points[0]), minus(points[2], points[0]))};
  std::vector<Half_space<3>> result{plane, opposite(plane)};
  for (std::size_t k = 0; k < points.size(); ++k)
    result.push_back(
        {points[k], exact_cross(plane.normal, minus(points[(k + 1) % points.size()], points[k]))});
  return result;
}

std::vector<Half_space<2>> half_spaces_of_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k) {
  const auto v = exact<2>(cell.point(cell.loop(i)[k]));
  return {{v, {1, 0}}, {v, {-1, 0}}, {v, {0, 1}}, {v, {0, -1}}};
}

std::vector<Half_space<3>> half_spaces_of_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k) {
  const auto loop = cell.loop(i);
  const auto u = exact<3>(cell.point(loop[k])), v = exact<3>(cell.point(loop[(k + 1) % loop.size()]));
  std::vector<Half_space<3>> result = half_spaces(cell, i);
  result.resize(2);
  const Half_space<3> side{u, exact_cross(result[0].normal, minus(v, u))};
  result.insert(result.end(), {side, opposite(side), {u, minus(v, u)}, {v, minus(u, v)}});
  return result;
}

}  // namespace cellwalk::detail
