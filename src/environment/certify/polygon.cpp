// SPDX-License-Identifier: LGPL-3.0-or-later
// The projection axis, and the tests of planarity, convexity and separation of polygons.
#include "polygon.h"

#include <cmath>
#include <utility>

namespace cellwalk::detail {

int projection_axis(Predicate_counts& counts, const Point<3>& p, const Point<3>& q, const Point<3>& r) {
  // The axis of the largest component of the rounded normal is only the best first guess.
  const Vector<3> normal = cross(q - p, r - p);
  std::array<int, 3> axes{0, 1, 2};
  const auto before = [&](int i, int j) { return std::abs(normal[i]) < std::abs(normal[j]); };
  if (before(axes[0], axes[1])) std::swap(axes[0], axes[1]);
  if (before(axes[0], axes[2])) std::swap(axes[0], axes[2]);
  for (const int axis : axes)
    if (turn(counts, p, q, r, axis) != 0) return axis;
  return -1;
}

bool find_corners(Predicate_counts& counts, std::span<const Point<3>> polygon, Corners& corners) {
  const std::size_t n = polygon.size();
  std::size_t second = 1;
  while (second < n && polygon[second] == polygon[0]) ++second;
  for (std::size_t third = second + 1; third < n; ++third) {
    const int axis = projection_axis(counts, polygon[0], polygon[second], polygon[third]);
    if (axis < 0) continue;
    corners = {{0, second, third}, axis};
    return true;
  }
  return false;
}

bool is_planar(Predicate_counts& counts, std::span<const Point<3>> polygon, const Corners& corners) {
  // Facets in a coordinate plane are common, and need no sign.
  for (int i = 0; i < 3; ++i) {
    bool equal = true;
    for (const Point<3>& p : polygon) equal &= p[i] == polygon[0][i];
    if (equal) return true;
  }
  const auto [i, j, k] = corners.at;
  for (std::size_t l = 0; l < polygon.size(); ++l) {
    if (l == i || l == j || l == k) continue;
    if (Exact::orientation(counts, polygon[i], polygon[j], polygon[k], polygon[l]) != 0) return false;
  }
  return true;
}

int convex_turn(Predicate_counts& counts, std::span<const Point<2>> polygon) {
  // The sides' directions turn one way only, by less than half a turn each, so that they change between the
  // lexicographically rising and falling half of the circle twice in a full turn.
  const std::size_t n = polygon.size();
  int sign = 0;
  std::size_t reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point<2>&a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    if (a == b) return 0;
    const bool reverses = (a < b) != (b < c);
    reversals += reverses;
    const int side = Exact::orientation(counts, a, b, c);
    if (side == 0 && (reverses || b == c)) return 0;  // a spike
    if (side != 0 && sign != 0 && side != sign) return 0;
    if (side != 0) sign = side;
  }
  return reversals == 2 ? sign : 0;
}

bool are_apart(Predicate_counts& counts, std::span<const Point<2>> a, std::span<const Point<2>> b, int sign) {
  // Disjoint convex polygons are separated by the line of a side of one of them.
  const auto has_separating_side = [&](std::span<const Point<2>> p, std::span<const Point<2>> q) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      bool separates = true;
      for (std::size_t j = 0; separates && j < q.size(); ++j)
        separates = sign * Exact::orientation(counts, p[i], p[(i + 1) % p.size()], q[j]) <= 0;
      if (separates) return true;
    }
    return false;
  };
  return has_separating_side(a, b) || has_separating_side(b, a);
}

}  // namespace cellwalk::detail
