// SPDX-License-Identifier: LGPL-3.0-or-later
// Obstacles are intersections of half-spaces, by which the triangle of barycentric coordinates of the swept
// triangle abq is clipped: a corner (x,y,z) of what is left is the point (x a + y b + z q) / (x + y + z), of
// the edge at time y / (x + y). Only times are fractions.
#include "edge/rational_touch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace cellwalk::test {
namespace {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using Vec = std::array<Integer, 3>;

Vec minus(const Vec& a, const Vec& b) {
  return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}
Integer dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]),
          Integer(a[0] * b[1] - a[1] * b[0])};
}
bool is_zero(const Vec& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// The points in units of a power of two of which all coordinates are multiples.
std::vector<Vec> to_integers(std::span<const Point<3>> points) {
  constexpr int bits = std::numeric_limits<double>::digits;
  int unit = 0;
  for (const Point<3>& p : points)
    for (double x : p)
      if (x != 0) unit = std::min(unit, std::ilogb(x) - bits + 1);
  std::vector<Vec> integers;
  for (const Point<3>& p : points) {
    Vec& v = integers.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      int exponent = 0;
      const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(p[i], &exponent), bits));
      const int shift = exponent - bits - unit;  // below 0 for 0 only: frexp and ilogb agree
      v[i] = mantissa;
      if (mantissa != 0) v[i] *= Integer(1) << shift;
    }
  }
  return integers;
}

/// The points x with normal . (x - origin) <= 0.
struct Half_space {
  Vec normal, origin;
};

void add_plane(std::vector<Half_space>& obstacle, const Vec& normal, const Vec& origin) {
  obstacle.push_back({normal, origin});
  obstacle.push_back({{Integer(-normal[0]), Integer(-normal[1]), Integer(-normal[2])}, origin});
}

std::vector<Half_space> half_spaces(std::span<const Vec> v) {
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

/// The corners of the part of a triangle, which may be flat, in an obstacle: multiples of their barycentric
/// coordinates.
std::vector<Vec> clip(const std::array<Vec, 3>& triangle, const std::vector<Half_space>& obstacle) {
  std::vector<Vec> corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Half_space& h : obstacle) {
    Vec heights;
    for (std::size_t i = 0; i < 3; ++i) heights[i] = dot(h.normal, minus(triangle[i], h.origin));
    std::vector<Vec> left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec &u = corners[i], &v = corners[(i + 1) % corners.size()];
      const Integer at_u = dot(heights, u), at_v = dot(heights, v);
      if (at_u <= 0) left.push_back(u);
      if (!((at_u < 0 && at_v > 0) || (at_u > 0 && at_v < 0))) continue;
      const Integer of_u = abs(at_v), of_v = abs(at_u);
      Vec& between = left.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) between[k] = of_u * u[k] + of_v * v[k];
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
    const Integer at_a = dot(h.normal, minus(a, h.origin)), at_b = dot(h.normal, minus(b, h.origin));
    if (at_a > 0 && at_b > 0) return {};
    if (at_a > 0) low = std::max(low, Rational(at_a, Integer(at_a - at_b)));
    if (at_b > 0) high = std::min(high, Rational(Integer(-at_a), Integer(at_b - at_a)));
  }
  if (low > high) return {};
  return {{low, high}};
}

/// The swept triangle is a segment: points that were not in the edge are passed by its moving end alone, once
/// it goes away from q.
std::optional<Rational> later_on_line(const Vec& a, const Vec& b, const Vec& q,
                                      const std::vector<Half_space>& obstacle) {
  const Vec path = minus(b, a);
  if (is_zero(path)) return {};
  const Rational at_q(dot(minus(q, a), path), dot(path, path));
  const auto times = times_of_point(a, b, obstacle);
  const Rational leaves = std::max(Rational(0), at_q);
  if (!times || (*times)[1] <= leaves) return {};
  return std::max(leaves, (*times)[0]);
}

/// True if the boxes of the triangle and the obstacle lie apart.
bool boxes_apart(const std::array<Point<3>, 3>& triangle, std::span<const Point<3>> obstacle) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto by_coordinate = [i](const auto& x, const auto& y) { return x[i] < y[i]; };
    const auto [low, high] = std::minmax_element(triangle.begin(), triangle.end(), by_coordinate);
    const auto [least, most] = std::minmax_element(obstacle.begin(), obstacle.end(), by_coordinate);
    if ((*high)[i] < (*least)[i] || (*most)[i] < (*low)[i]) return true;
  }
  return false;
}

Rational_touch touch(const std::array<Point<3>, 3>& swept, std::span<const Point<3>> points) {
  Rational_touch r;
  if (boxes_apart(swept, points)) return r;
  std::vector<Point<3>> all(points.begin(), points.end());
  all.insert(all.end(), swept.begin(), swept.end());
  const std::vector<Vec> v = to_integers(all);
  const std::vector<Half_space> obstacle = half_spaces(std::span(v).first(points.size()));
  const Vec &a = v[points.size()], &b = v[points.size() + 1], &q = v[points.size() + 2];
  r.at_start = !clip({a, a, q}, obstacle).empty();
  if (is_zero(cross(minus(b, a), minus(q, a)))) {
    r.later = later_on_line(a, b, q, obstacle);
    return r;
  }
  // Time is monotonous along each side of what the obstacle leaves, and constant on sides that end in q.
  Rational last = 0;
  for (const Vec& corner : clip({a, b, q}, obstacle)) {
    if (corner[0] + corner[1] == 0) continue;  // q
    const Rational time(corner[1], Integer(corner[0] + corner[1]));
    if (!r.later || time < *r.later) r.later = time;
    last = std::max(last, time);
  }
  if (last == 0) r.later.reset();
  return r;
}

}  // namespace

Rational_touch touch_of_edge(const Point<3>& a, const Point<3>& b, const Point<3>& q,
                             std::span<const Point<3>> obstacle) {
  return touch({a, b, q}, obstacle);
}

Rational_touch touch_of_point(const Point<3>& a, const Point<3>& b, std::span<const Point<3>> obstacle) {
  return touch({a, b, a}, obstacle);
}

bool segment_meets(const Point<3>& u, const Point<3>& v, std::span<const Point<3>> obstacle) {
  return touch_of_point(u, v, obstacle).any();
}

}  // namespace cellwalk::test
