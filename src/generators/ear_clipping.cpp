// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact tests of ears and bridges of a polygon.
#include "ear_clipping.h"

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <limits>

namespace cellwalk::detail {
namespace {

int turn(std::span<const Point<2>> points, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Predicate_counts counts;
  return Exact::orientation(counts, points[a], points[b], points[c]);
}

/// True if the triangle a, b, c of consecutive vertices can be cut off: it turns left, and no other vertex
/// touches it. Copies of its own corners, at the ends of a bridge, do not count: an edge from one into the
/// triangle would have to end in it or cross the opposite edge.
bool is_ear(std::span<const Point<2>> points, const Polygon_indices& polygon, std::uint32_t a,
            std::uint32_t b, std::uint32_t c) {
  if (turn(points, a, b, c) <= 0) return false;
  for (std::uint32_t v : polygon) {
    if (v == a || v == b || v == c) continue;
    if (turn(points, a, b, v) >= 0 && turn(points, b, c, v) >= 0 && turn(points, c, a, v) >= 0) return false;
  }
  return true;
}

/// True if the closed segments have a point in common; a segment touches those that start at its own ends.
bool meet(std::span<const Point<2>> points, std::uint32_t a, std::uint32_t b, std::uint32_t c,
          std::uint32_t d) {
  const int ac = turn(points, a, b, c), ad = turn(points, a, b, d), ca = turn(points, c, d, a),
            cb = turn(points, c, d, b);
  if (ac * ad > 0 || ca * cb > 0) return false;
  if (ac != 0 || ad != 0) return true;
  // Collinear segments meet if their boxes do.
  for (int i = 0; i < 2; ++i) {
    const auto [low, high] = std::minmax(points[a][i], points[b][i]);
    const auto [from, to] = std::minmax(points[c][i], points[d][i]);
    if (high < from || to < low) return false;
  }
  return true;
}

/// True if the segment meets no edge of the polygon except at its own ends.
bool is_clear(std::span<const Point<2>> points, const Polygon_indices& polygon, std::uint32_t a,
              std::uint32_t b) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::uint32_t c = polygon[i], d = polygon[(i + 1) % polygon.size()];
    if (c == a || c == b || d == a || d == b) {
      const std::uint32_t other = c == a || c == b ? d : c;
      if (meet(points, a, b, other, other)) return false;
    } else if (meet(points, a, b, c, d)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clip_ears(std::span<const Point<2>> points,
                                                    Polygon_indices polygon) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (polygon.size() >= 3) {
    // The ear with the shortest cut, for well-shaped triangles.
    const std::size_t n = polygon.size();
    std::size_t best = n;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
      const double cut = length(points[c] - points[a]);
      if (cut < shortest && is_ear(points, polygon, a, b, c)) best = i, shortest = cut;
    }
    if (best == n) throw Error(Error_code::other, "ear clipping: the polygon is not simple");
    triangles.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

Polygon_indices bridge(std::span<const Point<2>> points, const Polygon_indices& outer,
                       const Polygon_indices& inner) {
  for (std::size_t i = 0; i < outer.size(); ++i)
    for (std::size_t j = 0; j < inner.size(); ++j) {
      if (!is_clear(points, outer, outer[i], inner[j]) || !is_clear(points, inner, outer[i], inner[j]))
        continue;
      Polygon_indices joined;
      for (std::size_t k = 0; k <= outer.size(); ++k) joined.push_back(outer[(i + k) % outer.size()]);
      for (std::size_t k = 0; k <= inner.size(); ++k)
        joined.push_back(inner[(j + inner.size() - k) % inner.size()]);
      return joined;
    }
  throw Error(Error_code::other, "ear clipping: no bridge between two polygons that should be nested");
}

}  // namespace cellwalk::detail
