// SPDX-License-Identifier: LGPL-3.0-or-later
// The bounding planes of facets and of the sides of their ridges.
#include "half_space.h"

namespace cellwalk::detail {
namespace {

template <int D>
Half_space<D> opposite(const Half_space<D>& h) {
  return {h.point, negative(h.normal)};
}

template <int D>
Half_spaces<D> half_spaces_of(const Cell_view<D>& cell, std::size_t i) {
  Half_spaces<D> result;
  result.push_back(plane_of(cell, i));
  result.push_back(opposite(result[0]));
  const std::size_t sides = cell.loop(i).size();
  for (std::size_t k = 0; k < sides; ++k) result.push_back(side_space(cell, i, k, result[0]));
  return result;
}

}  // namespace

Half_space<2> plane_of(const Cell_view<2>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const auto u = exact<2>(cell.point(loop[0])), v = exact<2>(cell.point(loop[1]));
  return {u, {u[1] - v[1], v[0] - u[0]}};
}

Half_space<3> plane_of(const Cell_view<3>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const auto u = exact<3>(cell.point(loop[0])), v = exact<3>(cell.point(loop[1])),
             w = exact<3>(cell.point(loop[2]));
  return {u, exact_cross(minus(v, u), minus(w, u))};
}

Half_space<2> side_space(const Cell_view<2>& cell, std::size_t i, std::size_t k, const Half_space<2>&) {
  const auto loop = cell.loop(i);
  const auto u = exact<2>(cell.point(loop[k])), v = exact<2>(cell.point(loop[1 - k]));
  return {u, minus(v, u)};
}

Half_space<3> side_space(const Cell_view<3>& cell, std::size_t i, std::size_t k, const Half_space<3>& plane) {
  const auto loop = cell.loop(i);
  const auto u = exact<3>(cell.point(loop[k])),
             v = exact<3>(cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]));
  return {u, exact_cross(plane.normal, minus(v, u))};
}

Half_spaces<2> half_spaces(const Cell_view<2>& cell, std::size_t i) { return half_spaces_of<2>(cell, i); }
Half_spaces<3> half_spaces(const Cell_view<3>& cell, std::size_t i) { return half_spaces_of<3>(cell, i); }

Half_spaces<2> half_spaces_of_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k) {
  const auto v = exact<2>(cell.point(cell.loop(i)[k]));
  return {{v, {1, 0}}, {v, {-1, 0}}, {v, {0, 1}}, {v, {0, -1}}};
}

Half_spaces<3> half_spaces_of_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k) {
  const auto loop = cell.loop(i);
  const auto u = exact<3>(cell.point(loop[k])), v = exact<3>(cell.point(loop[(k + 1) % loop.size()]));
  const Half_space<3> plane = plane_of(cell, i), side = side_space(cell, i, k, plane);
  return {plane, opposite(plane), side, opposite(side), {u, minus(v, u)}, {v, minus(u, v)}};
}

}  // namespace cellwalk::detail
