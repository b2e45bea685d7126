// SPDX-License-Identifier: LGPL-3.0-or-later
// Fans and ear clippings of a polygon, all of whose triangles are positive.
#include "polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "environment/certify/polygon.h"

namespace cellwalk::detail {
namespace {

/// \pre a, b and p are collinear
bool is_between(const Point<2>& a, const Point<2>& b, const Point<2>& p) {
  return a < b ? !(p < a) && !(b < p) : !(p < b) && !(a < p);
}

/// True if the closed segments ab and cd have a point in common.
bool meet(Predicate_counts& counts, const Point<2>& a, const Point<2>& b, const Point<2>& c,
          const Point<2>& d) {
  const int abc = Exact::orientation(counts, a, b, c), abd = Exact::orientation(counts, a, b, d);
  const int cda = Exact::orientation(counts, c, d, a), cdb = Exact::orientation(counts, c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
         (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
}

bool is_simple(Predicate_counts& counts, std::span<const Point<2>> p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point<2>&a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    if (a == b) return false;
    if ((a < b) != (b < c) && Exact::orientation(counts, a, b, c) == 0) return false;  // a spike
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && meet(counts, a, b, p[j], p[(j + 1) % n])) return false;
  }
  return true;
}

/// All triangles of the fan from vertex `apex`, or nothing if one is not positive.
Triangulation fan(Predicate_counts& counts, std::span<const Point<2>> p, int sign, std::size_t apex) {
  const std::size_t n = p.size();
  Triangulation triangles;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const std::size_t j = (apex + i) % n, k = (apex + i + 1) % n;
    if (sign * Exact::orientation(counts, p[apex], p[j], p[k]) <= 0) return {};
    triangles.push_back(
        {static_cast<std::uint32_t>(apex), static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(k)});
  }
  return triangles;
}

/// Cuts the first ear in the given order of vertices until one triangle is left. The closed triangle of an
/// ear contains no other vertex, so the rest is a simple polygon without spikes. In a triangulation of the
/// polygon (one exists) a triangle with two sides on the boundary is such an ear.
Triangulation cut_ears(Predicate_counts& counts, std::span<const Point<2>> p, int sign,
                       std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> ring(p.size());
  std::iota(ring.begin(), ring.end(), 0u);
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
    const Point<2>&a = p[ring[before]], &b = p[ring[i]], &c = p[ring[after]];
    if (sign * Exact::orientation(counts, a, b, c) <= 0) return false;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == before || j == i || j == after) continue;
      const Point<2>& x = p[ring[j]];
      if (sign * Exact::orientation(counts, a, b, x) >= 0 &&
          sign * Exact::orientation(counts, b, c, x) >= 0 && sign * Exact::orientation(counts, c, a, x) >= 0)
        return false;
    }
    return true;
  };
  Triangulation triangles;
  while (ring.size() > 3) {
    bool found = false;
    for (const std::uint32_t v : order) {
      const auto at = std::find(ring.begin(), ring.end(), v);
      if (at == ring.end()) continue;
      const auto i = static_cast<std::size_t>(at - ring.begin());
      if (!is_ear(i)) continue;
      const std::size_t n = ring.size();
      triangles.push_back({ring[(i + n - 1) % n], v, ring[(i + 1) % n]});
      ring.erase(at);
      found = true;
      break;
    }
    if (!found) return {};
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

/// Adds a triangulation, if there is one and it is new.
void add(std::vector<Triangulation>& list, Triangulation triangles) {
  if (triangles.empty()) return;
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  if (std::find(list.begin(), list.end(), triangles) == list.end()) list.push_back(std::move(triangles));
}

/// Replaces positions in a loop by the point indices there.
void to_points(std::vector<Triangulation>& list, std::span<const std::uint32_t> loop) {
  for (Triangulation& triangles : list)
    for (Triangle& t : triangles) t = {loop[t[0]], loop[t[1]], loop[t[2]]};
}

/// Axes by the size of that component of the polygon's rounded mean normal, largest first.
std::array<int, 3> axes_by_normal(std::span<const Point<3>> polygon) {
  Vector<3> normal{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal = normal + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int i, int j) { return std::abs(normal[i]) > std::abs(normal[j]); });
  return axes;
}

}  // namespace

int simple_turn(Predicate_counts& counts, std::span<const Point<2>> polygon) {
  const std::size_t n = polygon.size();
  if (const int sign = convex_turn(counts, polygon); sign != 0) return sign;
  if (!is_simple(counts, polygon)) return 0;
  // The lexicographically lowest vertex is a corner of the convex hull.
  const std::size_t i = std::min_element(polygon.begin(), polygon.end()) - polygon.begin();
  return Exact::orientation(counts, polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]);
}

std::vector<Triangulation> triangulations(Predicate_counts& counts, std::span<const Point<2>> polygon,
                                          int sign, std::span<const std::uint32_t> rank, std::size_t most) {
  std::vector<std::uint32_t> order(polygon.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return rank[i] < rank[j]; });
  std::vector<Triangulation> list;
  for (const std::uint32_t apex : order) {
    add(list, fan(counts, polygon, sign, apex));
    if (list.size() >= most) return list;
  }
  if (polygon.size() == 4 && !list.empty()) return list;  // a quadrilateral has no others
  add(list, cut_ears(counts, polygon, sign, order));
  if (list.size() >= most) return list;
  std::reverse(order.begin(), order.end());
  add(list, cut_ears(counts, polygon, sign, order));
  return list;
}

std::vector<std::uint32_t> canonical_loop(std::span<const std::uint32_t> loop) {
  const std::size_t n = loop.size();
  const std::size_t low = std::min_element(loop.begin(), loop.end()) - loop.begin();
  const bool forward = loop[(low + 1) % n] < loop[(low + n - 1) % n];
  std::vector<std::uint32_t> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = loop[(low + (forward ? i : n - i)) % n];
  return result;
}

std::vector<Triangulation> facet_triangulations(Predicate_counts& counts, std::span<const Point<3>> points,
                                                std::span<const std::uint32_t> loop, std::size_t most) {
  Polygon<3> polygon;
  for (const std::uint32_t v : loop) polygon.push_back(points[v]);
  const std::span<const Point<3>> corners_of(polygon.data(), polygon.size());
  std::vector<Triangulation> list;
  for (const int axis : axes_by_normal(corners_of)) {
    const Polygon<2> flat = drop(polygon, axis);
    const std::span<const Point<2>> flat_points(flat.data(), flat.size());
    const int sign = simple_turn(counts, flat_points);
    if (sign == 0) continue;
    list = triangulations(counts, flat_points, sign, loop, most);
    break;
  }
  // In a facet that is not planar, any fan without flat triangles may suit the cell, even if its projection
  // is folded.
  Corners corners;
  if (list.size() >= most || !find_corners(counts, corners_of, corners) ||
      is_planar(counts, corners_of, corners)) {
    to_points(list, loop);
    return list;
  }
  const auto n = static_cast<std::uint32_t>(loop.size());
  for (std::uint32_t apex = 0; apex < n; ++apex) {
    Triangulation triangles;
    for (std::uint32_t i = 1; i + 1 < n; ++i) triangles.push_back({apex, (apex + i) % n, (apex + i + 1) % n});
    if (std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
          return projection_axis(counts, polygon[t[0]], polygon[t[1]], polygon[t[2]]) >= 0;
        }))
      add(list, std::move(triangles));
  }
  to_points(list, loop);
  return list;
}

}  // namespace cellwalk::detail
