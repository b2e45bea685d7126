// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/rational_sweep.h"

#include <boost/multiprecision/gmp.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "edge/integer_scale.h"

namespace cellwalk::test {
namespace {

using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
template <std::size_t D>
using Vec = std::array<Rational, D>;

template <std::size_t D>
Vec<D> exact(const std::array<double, D>& p, int exponent = 0) {
  Vec<D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = Rational(std::ldexp(p[i], exponent));
  return r;
}

template <std::size_t D>
Vec<D> minus(const Vec<D>& a, const Vec<D>& b) {
  Vec<D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

template <std::size_t D>
Rational dot(const Vec<D>& a, const Vec<D>& b) {
  Rational r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

template <std::size_t D>
Vec<D> on(const Vec<D>& a, const Vec<D>& b, const Rational& t) {
  Vec<D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] + t * (b[i] - a[i]);
  return r;
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Normal of the line or plane of a facet; longest of all choices, so not 0 where vertices are collinear.
Vec<2> normal(const std::vector<Vec<2>>& facet) {
  const Vec<2> e = minus(facet[1], facet[0]);
  return {-e[1], e[0]};
}

Vec<3> normal(const std::vector<Vec<3>>& facet) {
  Vec<3> best{0, 0, 0};
  for (std::size_t i = 2; i < facet.size(); ++i) {
    const Vec<3> n = cross(minus(facet[i - 1], facet[0]), minus(facet[i], facet[0]));
    if (dot(n, n) > dot(best, best)) best = n;
  }
  return best;
}

template <std::size_t D>
std::vector<Vec<D>> exact(std::span<const std::array<double, D>> points, int exponent = 0) {
  std::vector<Vec<D>> r;
  for (const auto& p : points) r.push_back(exact(p, exponent));
  return r;
}

/// Parameters along a direction of the points in which the boundary of a convex polygon crosses a plane,
/// where the polygon has vertices strictly on both sides; empty otherwise.
std::optional<std::array<Rational, 2>> cut(const std::vector<Vec<3>>& polygon, const Vec<3>& origin,
                                           const Vec<3>& n, const Vec<3>& direction) {
  std::vector<Rational> heights;
  for (const auto& v : polygon) heights.push_back(dot(n, minus(v, origin)));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  if (*low >= 0 || *high <= 0) return {};
  std::vector<Rational> places;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = (i + 1) % polygon.size();
    if (heights[i] == 0) places.push_back(dot(direction, polygon[i]));
    if (heights[i] * heights[j] < 0)
      places.push_back(
          dot(direction, on(polygon[i], polygon[j], Rational(heights[i] / (heights[i] - heights[j])))));
  }
  return {{*std::min_element(places.begin(), places.end()), *std::max_element(places.begin(), places.end())}};
}

/// True if x, a point of the plane of a convex facet, lies in it.
bool holds(const std::vector<Vec<2>>& facet, const Vec<2>& x) {
  return dot(minus(x, facet[0]), minus(x, facet[1])) <= 0;
}

bool holds(const std::vector<Vec<3>>& facet, const Vec<3>& x) {
  const Vec<3> n = normal(facet);
  for (std::size_t i = 0; i < facet.size(); ++i) {
    const auto& v = facet[i];
    if (dot(n, cross(minus(facet[(i + 1) % facet.size()], v), minus(x, v))) < 0) return false;
  }
  return true;
}

/// True if the boxes of a triangle and a facet lie apart.
template <std::size_t D>
bool boxes_apart(const std::array<std::array<double, D>, 3>& triangle,
                 std::span<const std::array<double, D>> facet) {
  for (std::size_t i = 0; i < D; ++i) {
    const auto by_coordinate = [i](const auto& x, const auto& y) { return x[i] < y[i]; };
    const auto [low, high] = std::minmax_element(triangle.begin(), triangle.end(), by_coordinate);
    const auto [least, most] = std::minmax_element(facet.begin(), facet.end(), by_coordinate);
    if ((*high)[i] < (*least)[i] || (*most)[i] < (*low)[i]) return true;
  }
  return false;
}

template <std::size_t D>
bool in_order(const std::array<double, D>& p_, const std::array<double, D>& q_,
              const std::vector<std::vector<std::array<double, D>>>& facets) {
  const Vec<D> p = exact(p_), q = exact(q_);
  Rational last = 0;
  for (const auto& points : facets) {
    const auto facet = exact<D>(points);
    const Vec<D> n = normal(facet);
    const Rational at_p = dot(n, minus(p, facet[0])), at_q = dot(n, minus(q, facet[0]));
    if (at_p == at_q) return false;
    const Rational t = at_p / (at_p - at_q);
    if (t < last || t > 1 || !holds(facet, on(p, q, t))) return false;
    last = t;
  }
  return true;
}

/// The time at which the segment from a + s (b - a) to q passes x, a point of the triangle in the plane.
Rational time_of(const Vec<2>& a, const Vec<2>& b, const Vec<2>& q, const Vec<2>& x) {
  const auto area = [&](const Vec<2>& u, const Vec<2>& v) {
    const Vec<2> d = minus(u, x), e = minus(v, x);
    return Rational(d[0] * e[1] - d[1] * e[0]);
  };
  const Rational of_a = area(b, q), of_b = area(q, a);
  return of_b / (of_a + of_b);
}

/// The same in space, in the coordinate plane in which the triangle is not a segment.
Rational time_of(const Vec<3>& a, const Vec<3>& b, const Vec<3>& q, const Vec<3>& x) {
  const Vec<3> n = cross(minus(b, a), minus(q, a));
  const std::size_t axis = n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
  const auto drop = [axis](const Vec<3>& v) { return Vec<2>{v[(axis + 1) % 3], v[(axis + 2) % 3]}; };
  return time_of(drop(a), drop(b), drop(q), drop(x));
}

/// The part of a facet that lies in the open triangle, by its ends; see crosses().
std::optional<std::array<Vec<2>, 2>> overlap(const Vec<2>& a, const Vec<2>& b, const Vec<2>& q,
                                             const std::vector<Vec<2>>& facet) {
  // The part of the segment that is strictly inside all sides of the triangle.
  const std::array<Vec<2>, 3> corners{a, b, q};
  const Vec<2>&u = facet[0], &v = facet[1];
  Rational low = 0, high = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec<2>&c = corners[i], &d = corners[(i + 1) % 3];
    Vec<2> n{c[1] - d[1], d[0] - c[0]};
    const Rational third = dot(n, minus(corners[(i + 2) % 3], c));
    if (third == 0) return {};  // no triangle
    if (third < 0) n = {-n[0], -n[1]};
    const Rational at_u = dot(n, minus(u, c)), at_v = dot(n, minus(v, c));
    if (at_u <= 0 && at_v <= 0) return {};
    if (at_u < 0) low = std::max<Rational>(low, at_u / (at_u - at_v));
    if (at_v < 0) high = std::min<Rational>(high, at_u / (at_u - at_v));
  }
  if (!(low < high)) return {};
  return {{on(u, v, low), on(u, v, high)}};
}

std::optional<std::array<Vec<3>, 2>> overlap(const Vec<3>& a, const Vec<3>& b, const Vec<3>& q,
                                             const std::vector<Vec<3>>& polygon) {
  const std::vector<Vec<3>> triangle{a, b, q};
  const Vec<3> n = normal(triangle), m = normal(polygon), line = cross(n, m);
  if (dot(line, line) == 0) return {};
  const auto of_triangle = cut(triangle, polygon[0], m, line), of_polygon = cut(polygon, a, n, line);
  if (!of_triangle || !of_polygon) return {};
  const Rational low = std::max((*of_triangle)[0], (*of_polygon)[0]);
  const Rational high = std::min((*of_triangle)[1], (*of_polygon)[1]);
  if (!(low < high)) return {};
  // A point of both planes: from where the polygon passes the plane of the triangle.
  Vec<3> on_both{};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<3>&u = polygon[i], &v = polygon[(i + 1) % polygon.size()];
    const Rational at_u = dot(n, minus(u, a)), at_v = dot(n, minus(v, a));
    if (at_u == at_v || at_u * at_v > 0) continue;
    on_both = on(u, v, Rational(at_u / (at_u - at_v)));
    break;
  }
  std::array<Vec<3>, 2> ends;
  for (std::size_t e = 0; e < 2; ++e) {
    const Rational t = ((e == 0 ? low : high) - dot(line, on_both)) / dot(line, line);
    for (std::size_t i = 0; i < 3; ++i) ends[e][i] = on_both[i] + t * line[i];
  }
  return ends;
}

/// A triangle and a facet in exact numbers: integers if the coordinates are not too far apart, since these
/// are faster. The unit makes no difference to what is asked.
template <std::size_t D>
struct Exact_pair {
  Vec<D> a, b, q;
  std::vector<Vec<D>> facet;

  Exact_pair(const std::array<std::array<double, D>, 3>& triangle,
             std::span<const std::array<double, D>> points) {
    Integer_scale scale;
    scale.add<D>(triangle);
    scale.add<D>(points);
    const int exponent = scale.exponent();
    a = exact(triangle[0], exponent);
    b = exact(triangle[1], exponent);
    q = exact(triangle[2], exponent);
    facet = exact<D>(points, exponent);
  }
};

/// The nearest double.
/// \pre x >= 0
double nearest(const Rational& x) {
  // The conversion cuts off.
  const double low = static_cast<double>(x),
               high = std::nextafter(low, std::numeric_limits<double>::infinity());
  return x - low <= high - x ? low : high;
}

template <std::size_t D>
bool crosses_facet(const std::array<std::array<double, D>, 3>& abq,
                   std::span<const std::array<double, D>> facet) {
  if (boxes_apart<D>(abq, facet)) return false;
  const Exact_pair<D> pair(abq, facet);
  return overlap(pair.a, pair.b, pair.q, pair.facet).has_value();
}

template <std::size_t D>
std::optional<double> first(const std::array<std::array<double, D>, 3>& abq,
                            std::span<const std::array<double, D>> facet) {
  if (boxes_apart<D>(abq, facet)) return {};
  const auto [a, b, q, points] = Exact_pair<D>(abq, facet);
  const auto ends = overlap(a, b, q, points);
  if (!ends) return {};
  // Along a line in the triangle the time is monotonous, and constant where the line passes q.
  std::optional<Rational> first;
  for (const Vec<D>& x : *ends) {
    if (x == q) continue;
    const Rational time = time_of(a, b, q, x);
    if (!first || time < *first) first = time;
  }
  return nearest(*first);
}

}  // namespace

bool crosses(const Point<2>& a, const Point<2>& b, const Point<2>& q, std::span<const Point<2>> facet) {
  return crosses_facet<2>({a, b, q}, facet);
}

bool crosses(const Point<3>& a, const Point<3>& b, const Point<3>& q, std::span<const Point<3>> facet) {
  return crosses_facet<3>({a, b, q}, facet);
}

std::optional<double> first_crossing(const Point<2>& a, const Point<2>& b, const Point<2>& q,
                                     std::span<const Point<2>> facet) {
  return first<2>({a, b, q}, facet);
}

std::optional<double> first_crossing(const Point<3>& a, const Point<3>& b, const Point<3>& q,
                                     std::span<const Point<3>> facet) {
  return first<3>({a, b, q}, facet);
}

bool meets_in_order(const Point<2>& p, const Point<2>& q, const std::vector<std::vector<Point<2>>>& facets) {
  return in_order<2>(p, q, facets);
}

bool meets_in_order(const Point<3>& p, const Point<3>& q, const std::vector<std::vector<Point<3>>>& facets) {
  return in_order<3>(p, q, facets);
}

}  // namespace cellwalk::test
