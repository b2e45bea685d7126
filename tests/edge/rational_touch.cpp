// SPDX-License-Identifier: LGPL-3.0-or-later
// Obstacles are intersections of half-spaces, by which the triangle of barycentric coordinates of the swept triangle abq is
// clipped: a corner (x,y,z) of what is left is the point x a + y b + z q, of the edge at time y / (x + y).
#include "edge/rational_touch.h"

#include <algorithm>
#include <vector>

namespace cellwalk::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Vec = std::array<Rational, 3>;

Vec exact(const Point<3>& p) { return {Rational(p[0]), Rational(p[1]), Rational(p[2])}; }
Vec minus(const Vec& a, const Vec& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}
Rational dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
          Rational(a[0] * b[1] - a[1] * b[0])};
}
bool is_zero(const Vec& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// The points x with normal . (x - origin) <= 0.
struct Half_space {
  Vec normal, origin;
};

void add_plane(std::vector<Half_space>& obstacle, const Vec& normal, const Vec& origin) {
  obstacle.push_back({normal, origin});
  obstacle.push_back({{Rational(-normal[0]), Rational(-normal[1]), Rational(-normal[2])}, origin});
}

std::vector<Half_space> half_spaces(std::span<const Point<3>> points) {
  std::vector<Vec> v;
  for (const Point<3>& p : points) v.push_back(exact(p));
  std::vector<Half_space> obstacle;
  if (v.size() == 2) {
    const Vec along = minus(v[1], v[0]);
    // Two planes that meet in the line: one that holds a coordinate axis that is not parallel to it, too.
    Vec across{};
    for (std::size_t axis = 0; axis < 3 && is_zero(across); ++axis) {
      Vec unit{0, 0, 0};
      unit[axis] = 1;
      across = cross(along, unit);
    }
    add_plane(obstacle, across, v[0]);
    add_plane(obstacle, cross(along, across), v[0]);
    obstacle.push_back({along, v[1]});
    obstacle.push_back({minus(v[0], v[1]), v[0]});
    return obstacle;
  }
  const Vec normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
  add_plane(obstacle, normal, v[0]);
  for (std::size_t i = 0; i < 3; ++i) obstacle.push_back({cross(minus(v[(i + 1) % 3], v[i]), normal), v[i]});
  return obstacle;
}

/// The corners in barycentric coordinates of the part of a triangle, which may be flat, in an obstacle.
std::vector<Vec> clip(const std::array<Vec, 3>& triangle, const std::vector<Half_space>& obstacle) {
  std::vector<Vec> corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Half_space& h : obstacle) {
    Vec heights;
    for (std::size_t i = 0; i < 3; ++i) heights[i] = dot(h.normal, minus(triangle[i], h.origin));
    std::vector<Vec> left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec &u = corners[i], &v = corners[(i + 1) % corners.size()];
      const Rational at_u = dot(heights, u), at_v = dot(heights, v);
      if (at_u <= 0) left.push_back(u);
      if (!((at_u < 0 && at_v > 0) || (at_u > 0 && at_v < 0))) continue;
      const Rational t = at_u / (at_u - at_v);
      Vec between;
      for (std::size_t k = 0; k < 3; ++k) between[k] = u[k] + t * (v[k] - u[k]);
      left.push_back(between);
    }
    corners = std::move(left);
    if (corners.empty()) break;
  }
  return corners;
}

/// The interval of times at which the point moving from a to b lies in the obstacle.
std::optional<std::array<Rational, 2>> times_of_point(const Vec& a, const Vec& b,
                                                      const std::vector<Half_space>& obstacle) {
  Rational low = 0, high = 1;
  for (const Half_space& h : obstacle) {
    const Rational at_a = dot(h.normal, minus(a, h.origin)), at_b = dot(h.normal, minus(b, h.origin));
    if (at_a > 0 && at_b > 0) return {};
    if (at_a > 0) low = std::max(low, Rational(at_a / (at_a - at_b)));
    if (at_b > 0) high = std::min(high, Rational(at_a / (at_a - at_b)));
  }
  if (low > high) return {};
  return {{low, high}};
}

/// The swept triangle is a segment: points that were not in the edge are passed by its moving end alone, once it goes away
/// from q.
std::optional<Rational> later_on_line(const Vec& a, const Vec& b, const Vec& q,
                                      const std::vector<Half_space>& obstacle) {
  const Vec way = minus(b, a);
  if (is_zero(way)) return {};
  const Rational at_q = dot(minus(q, a), way) / dot(way, way);
  const auto times = times_of_point(a, b, obstacle);
  const Rational leaves = std::max(Rational(0), at_q);
  if (!times || (*times)[1] <= leaves) return {};
  return std::max(leaves, (*times)[0]);
}

Rational_touch touch(const Vec& a, const Vec& b, const Vec& q, const std::vector<Half_space>& obstacle) {
  Rational_touch r;
  r.at_start = !clip({a, a, q}, obstacle).empty();
  if (is_zero(cross(minus(b, a), minus(q, a)))) {
    r.later = later_on_line(a, b, q, obstacle);
    return r;
  }
  // Time is monotonous along each side of what the obstacle leaves, and constant on sides that end in q.
  Rational last = 0;
  for (const Vec& corner : clip({a, b, q}, obstacle)) {
    if (corner[0] + corner[1] == 0) continue;  // q
    const Rational time = corner[1] / (corner[0] + corner[1]);
    if (!r.later || time < *r.later) r.later = time;
    last = std::max(last, time);
  }
  if (last == 0) r.later.reset();
  return r;
}

}  // namespace

Rational_touch touch_of_edge(const Point<3>& a, const Point<3>& b, const Point<3>& q,
                             std::span<const Point<3>> obstacle) {
  return touch(exact(a), exact(b), exact(q), half_spaces(obstacle));
}

Rational_touch touch_of_point(const Point<3>& a, const Point<3>& b, std::span<const Point<3>> obstacle) {
  return touch(exact(a), exact(b), exact(a), half_spaces(obstacle));
}

bool segment_meets(const Point<3>& u, const Point<3>& v, std::span<const Point<3>> obstacle) {
  return touch_of_point(u, v, obstacle).any();
}

}  // namespace cellwalk::test
