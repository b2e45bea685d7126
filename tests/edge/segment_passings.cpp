// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/segment_passings.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace cellwalk::oracle {
namespace {

template <std::size_t D>
using Vec = std::array<Big, D>;
template <int D>
using Points = std::map<std::uint32_t, Vec<D>>;  ///< vertices, by number

/// Twice the area of the triangle pqx.
Big area(const Vec<2>& p, const Vec<2>& q, const Vec<2>& x) {
  const Vec<2> u = minus(q, p), v = minus(x, p);
  return u[0] * v[1] - u[1] * v[0];
}

template <int D>
Points<D> vertices(const Integer_complex<D>& complex, const std::vector<std::uint32_t>& cells,
                   int extra_shift) {
  Points<D> points;
  for (const std::uint32_t c : cells)
    for (std::size_t f = complex.soup.cell_begin[c]; f < complex.soup.cell_begin[c + 1]; ++f)
      for (const std::uint32_t v : complex.soup.facet(f)) {
        const auto [found, is_new] = points.try_emplace(v);
        if (!is_new) continue;
        for (int i = 0; i < D; ++i) found->second[i] = complex.points[v][i] << extra_shift;
      }
  return points;
}

/// When the segment passes x, both in the plane.
void add_passing(std::vector<Share>& times, const std::array<Vec<2>, 3>& abq, const Vec<2>& x) {
  const auto& [a, b, q] = abq;
  const Big at_a = area(a, q, x), at_b = area(b, q, x);
  // Not the points outside a triangle: beyond ab, or on the other side of q.
  const int turn = sign(area(a, b, q));
  if (turn * sign(at_a) > 0 || turn * sign(at_b) < 0 || turn * sign(area(a, b, x)) < 0) return;
  add_root(times, at_a, at_b);
}

void add_all(std::vector<Share>& times, const Integer_complex<2>&, const std::vector<std::uint32_t>&,
             const Points<2>& points, const std::array<Vec<2>, 3>& abq) {
  for (const auto& [v, x] : points) add_passing(times, abq, x);
}

void add_all(std::vector<Share>& times, const Integer_complex<3>& complex,
             const std::vector<std::uint32_t>& cells, const Points<3>& points,
             const std::array<Vec<3>, 3>& abq) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::uint32_t c : cells)
    for (std::size_t f = complex.soup.cell_begin[c]; f < complex.soup.cell_begin[c + 1]; ++f) {
      const auto loop = complex.soup.facet(f);
      for (std::size_t i = 0; i < loop.size(); ++i)
        edges.insert(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
    }
  const auto& [a, b, q] = abq;
  const Vec<3> normal = cross(minus(b, a), minus(q, a));
  std::size_t axis = 0;
  while (axis < 2 && normal[axis] == 0) ++axis;
  const bool is_triangle = normal[axis] != 0;
  const auto drop = [axis](const Vec<3>& x) { return Vec<2>{x[(axis + 1) % 3], x[(axis + 2) % 3]}; };
  std::map<std::uint32_t, int> sides;  // of the plane of the triangle
  for (const auto& [v, x] : points) {
    sides[v] = sign(dot(normal, minus(x, a)));
    if (sides[v] == 0) add_passing(times, {drop(a), drop(b), drop(q)}, drop(x));
  }
  for (const auto& [u, v] : edges) {
    // Passes the plane of the triangle nowhere, or in a vertex.
    if (is_triangle && sides[u] * sides[v] >= 0) continue;
    const Vec<3>& x = points.at(u);
    const Vec<3> along = minus(points.at(v), x), to_a = minus(a, x);
    const Vec<3> across = cross(minus(q, x), along);
    const Big at_a = dot(across, to_a), at_b = dot(across, minus(b, x));
    if (sign(at_a) * sign(at_b) > 0) continue;
    // Where the line of the edge meets the triangle, it passes its three sides in the same turn.
    const int turn = sign(at_b) == 0 ? -sign(at_a) : sign(at_b);
    if (is_triangle && turn * sign(dot(cross(minus(b, x), along), to_a)) < 0) continue;
    add_root(times, at_a, at_b);
  }
}

}  // namespace

Share root(const Big& at_0, const Big& at_1) {
  if (at_0 > at_1) return {at_0, at_0 - at_1};
  return {-at_0, at_1 - at_0};
}

void add_root(std::vector<Share>& times, const Big& at_0, const Big& at_1) {
  if (at_0 == at_1 || sign(at_0) * sign(at_1) > 0) return;
  const Share t = root(at_0, at_1);
  const Big divisor = gcd(t.numerator, t.denominator);
  times.push_back({t.numerator / divisor, t.denominator / divisor});
}

template <int D>
void add_passings(std::vector<Share>& times, const Integer_complex<D>& complex,
                  const std::vector<std::uint32_t>& cells, int extra_shift,
                  const std::array<std::array<Big, D>, 3>& abq) {
  add_all(times, complex, cells, vertices(complex, cells, extra_shift), abq);
}

template void add_passings<2>(std::vector<Share>&, const Integer_complex<2>&,
                              const std::vector<std::uint32_t>&, int,
                              const std::array<std::array<Big, 2>, 3>&);
template void add_passings<3>(std::vector<Share>&, const Integer_complex<3>&,
                              const std::vector<std::uint32_t>&, int,
                              const std::array<std::array<Big, 3>, 3>&);

}  // namespace cellwalk::oracle
