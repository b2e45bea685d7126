// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest points of corners and faces, and of pairs of edges.
#include "narrow_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

/// Keeps the shorter of two ways.
void take(Near_triangles& best, const Point<3>& from, const Point<3>& to) {
  if (const double d = apart(from, to); d < best.distance) best.distance = d, best.at = from;
}

Point<3> on(const Point<3>& a, const Vector<3>& along, double t) { return a + t * along; }

/// The point of a segment that is nearest to another one.
Point<3> nearest(const Point<3>& p, const Point<3>& a, const Point<3>& b) {
  const Vector<3> along = b - a;
  const double squared = dot(along, along);
  return squared > 0 ? on(a, along, std::clamp(dot(p - a, along) / squared, 0.0, 1.0)) : a;
}

/// The foot of the perpendicular from a point to the plane of a triangle, if it lies in it; else the nearest
/// point of an edge.
void take_corner(Near_triangles& best, const Point<3>& p, const Triangle_corners& t) {
  const Vector<3> u = t[1] - t[0], v = t[2] - t[0], w = p - t[0], normal = cross(u, v);
  const double squared = dot(normal, normal);
  const double b = dot(cross(w, v), normal) / squared, c = dot(cross(u, w), normal) / squared;
  if (b >= 0 && c >= 0 && b + c <= 1) {
    // Not from the foot, which is rounded.
    const double d = std::abs(dot(w, normal)) / std::sqrt(squared);
    if (d < best.distance) best.distance = d, best.at = p;
  }
  for (std::size_t k = 0; k < 3; ++k) take(best, p, nearest(p, t[k], t[(k + 1) % 3]));
}

/// The inner points of two segments that are nearest to each other; their ends are corners.
void take_edges(Near_triangles& best, const Point<3>& a, const Point<3>& b, const Point<3>& c,
                const Point<3>& d) {
  const Vector<3> u = b - a, v = d - c, w = c - a, normal = cross(u, v);
  const double squared = dot(normal, normal);
  const double s = dot(cross(w, v), normal) / squared, t = dot(cross(w, u), normal) / squared;
  if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return;  // also if they are parallel
  const double distance = std::abs(dot(w, normal)) / std::sqrt(squared);
  // The direction of nearly parallel edges' normal is noise: then the points are farther apart than that.
  constexpr double rounding = 1e-14;
  if (apart(on(a, u, s), on(c, v, t)) > 2 * distance + rounding * (length(u) + length(v))) return;
  if (distance < best.distance) best.distance = distance, best.at = on(a, u, s);
}

}  // namespace

double apart(const Point<3>& a, const Point<3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Near_triangles distance_of(const Triangle_corners& a, const Triangle_corners& b,
                           const std::array<std::size_t, 3>& a_names,
                           const std::array<std::size_t, 3>& b_names) {
  Near_triangles best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto is_common = [](std::size_t corner, const std::array<std::size_t, 3>& names) {
    return std::find(names.begin(), names.end(), corner) != names.end();
  };
  for (const std::size_t corner : a_names) best.common_corners += is_common(corner, b_names);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_common(a_names[k], b_names)) take_corner(best, a[k], b);
    if (!is_common(b_names[k], a_names)) take_corner(best, b[k], a);
  }
  if (best.common_corners == 0)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) take_edges(best, a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
  return best;
}

}  // namespace cellwalk::detail
