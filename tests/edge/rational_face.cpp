// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/rational_face.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "edge/integer_scale.h"

namespace cellwalk::test {
namespace {

using Vec = std::array<Fraction, 3>;
using Polygon = std::vector<Vec>;

/// Points times a power of two, which makes no difference to what is asked.
Vec exact(const Point<3>& p, int exponent = 0) {
  Vec r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = Fraction(std::ldexp(p[i], exponent));
  return r;
}

Polygon exact(std::span<const Point<3>> points, int exponent = 0) {
  Polygon r;
  for (const auto& p : points) r.push_back(exact(p, exponent));
  return r;
}

int exponent_for(std::span<const Point<3>> points, std::span<const Point<3>> more) {
  Integer_scale scale;
  scale.add<3>(points);
  scale.add<3>(more);
  return scale.exponent();
}

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Fraction dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec on(const Vec& a, const Vec& b, const Fraction& t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}
int sign(const Fraction& x) { return (x > 0) - (x < 0); }
Fraction root_of(const Fraction& at_0, const Fraction& at_1) { return at_0 / (at_0 - at_1); }
bool is_zero(const Vec& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }
Fraction volume(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  return dot(cross(minus(b, a), minus(c, a)), minus(d, a));
}

/// Normal of a convex polygon by the turn of its vertices: the sum over a fan.
Vec normal(const Polygon& polygon) {
  Vec sum{0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec n = cross(minus(polygon[i - 1], polygon[0]), minus(polygon[i], polygon[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return sum;
}

/// True if the inside of a polygon holds a part of segment uv in its plane.
bool holds_part(const Polygon& polygon, const Vec& n, const Vec& u, const Vec& v) {
  Fraction low = 0, high = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec& c = polygon[i];
    const Vec inward = cross(n, minus(polygon[(i + 1) % polygon.size()], c));
    const Fraction at_u = dot(inward, minus(u, c)), at_v = dot(inward, minus(v, c));
    if (at_u <= 0 && at_v <= 0) return false;
    const Fraction root = at_u == at_v ? Fraction(0) : root_of(at_u, at_v);
    if (at_u < 0) low = std::max<Fraction>(low, root);
    if (at_v < 0) high = std::min<Fraction>(high, root);
  }
  return low < high;
}

bool is_pierced(const Polygon& face, const Polygon& facet) {
  const Vec n = normal(face);
  if (is_zero(n)) return false;
  std::vector<Fraction> heights;
  for (const Vec& v : facet) heights.push_back(dot(n, minus(v, face[0])));
  Polygon cut;  // where the boundary of the facet passes the plane
  bool above = false, below = false;
  for (std::size_t i = 0; i < facet.size(); ++i) {
    const std::size_t j = (i + 1) % facet.size();
    above |= heights[i] > 0;
    below |= heights[i] < 0;
    if (heights[i] == 0) cut.push_back(facet[i]);
    if (heights[i] * heights[j] < 0) cut.push_back(on(facet[i], facet[j], root_of(heights[i], heights[j])));
  }
  return above && below && holds_part(face, n, cut.front(), cut.back());
}

/// True if a side of the first polygon, whose normal is n, has the second one on its outer side.
bool is_parted(const Polygon& polygon, const Vec& n, const Polygon& other) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec& c = polygon[i];
    const Vec inward = cross(n, minus(polygon[(i + 1) % polygon.size()], c));
    if (std::all_of(other.begin(), other.end(), [&](const Vec& x) { return dot(inward, minus(x, c)) <= 0; }))
      return true;
  }
  return false;
}

bool is_overlapped(const Polygon& face, const Polygon& facet) {
  const Vec n = normal(face);
  if (is_zero(n)) return false;
  for (const Vec& v : facet)
    if (dot(n, minus(v, face[0])) != 0) return false;
  return !is_parted(face, n, facet) && !is_parted(facet, normal(facet), face);
}

/// The part of a polygon on the inner sides of another one, whose normal is n.
Polygon part(Polygon polygon, const Polygon& other, const Vec& n) {
  for (std::size_t i = 0; i < other.size(); ++i) {
    const Vec& c = other[i];
    const Vec inward = cross(n, minus(other[(i + 1) % other.size()], c));
    Polygon kept;
    for (std::size_t j = 0; j < polygon.size(); ++j) {
      const Vec &u = polygon[j], &v = polygon[(j + 1) % polygon.size()];
      const Fraction at_u = dot(inward, minus(u, c)), at_v = dot(inward, minus(v, c));
      if (at_u >= 0) kept.push_back(u);
      if (at_u * at_v < 0) kept.push_back(on(u, v, root_of(at_u, at_v)));
    }
    polygon = kept;
  }
  return polygon;
}

/// True if a polygon lies on the other side of the plane xyz than a further corner of a tetrahedron, or in
/// it.
bool is_outside(const Vec& x, const Vec& y, const Vec& z, const Vec& corner, const Polygon& polygon) {
  const Vec n = cross(minus(y, x), minus(z, x));
  const int inner = sign(dot(n, minus(corner, x)));
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const Vec& v) { return sign(dot(n, minus(v, x))) * inner <= 0; });
}

/// True if the boxes of a face with a further point and of a facet are apart.
bool boxes_apart(const Triangle& face, const Point<3>& b, std::span<const Point<3>> facet) {
  for (std::size_t i = 0; i < 3; ++i) {
    double low = b[i], high = b[i];
    for (const auto& x : face) {
      low = std::min(low, x[i]);
      high = std::max(high, x[i]);
    }
    const auto outside = [&](auto is_out) { return std::all_of(facet.begin(), facet.end(), is_out); };
    if (outside([&](const Point<3>& x) { return x[i] < low; }) ||
        outside([&](const Point<3>& x) { return x[i] > high; }))
      return true;
  }
  return false;
}

}  // namespace

bool pierces(const Triangle& face, std::span<const Point<3>> facet) {
  if (boxes_apart(face, face[0], facet)) return false;
  const int exponent = exponent_for(face, facet);
  return is_pierced(exact(face, exponent), exact(facet, exponent));
}

bool overlaps_in_plane(const Triangle& face, std::span<const Point<3>> facet) {
  if (boxes_apart(face, face[0], facet)) return false;
  const int exponent = exponent_for(face, facet);
  return is_overlapped(exact(face, exponent), exact(facet, exponent));
}

bool overlap_in_plane(const Triangle& face, std::span<const Point<3>> facet,
                      std::span<const Point<3>> other) {
  if (!overlaps_in_plane(face, facet) || !overlaps_in_plane(face, other)) return false;
  const int exponent = exponent_for(facet, other);
  const Polygon polygon = exact(other, exponent);
  const Polygon common = part(exact(facet, exponent), polygon, normal(polygon));
  return common.size() > 2 && !is_zero(normal(common)) && is_overlapped(exact(face, exponent), common);
}

int side_of_plane(std::span<const Point<3>> facet, const Point<3>& x) {
  const Polygon polygon = exact(facet);
  const Fraction height = dot(normal(polygon), minus(exact(x), polygon[0]));
  return sign(height);
}

int orientation_of(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  const Fraction v = volume(exact(a), exact(b), exact(c), exact(d));
  return sign(v);
}

bool on_one_line(const Triangle& face) { return is_zero(normal(exact(std::span<const Point<3>>(face)))); }

std::optional<Fraction> first_piercing(const Triangle& face, std::size_t k, const Point<3>& b,
                                       std::span<const Point<3>> facet) {
  if (boxes_apart(face, b, facet)) return {};
  const std::array<Point<3>, 4> corners{face[k], b, face[(k + 1) % 3], face[(k + 2) % 3]};
  const int exponent = exponent_for(corners, facet);
  const Polygon polygon = exact(facet, exponent), swept = exact(corners, exponent);
  const Vec &from = swept[0], &to = swept[1], &q = swept[2], &r = swept[3];
  const Vec n = normal(polygon);
  const auto is_beside = [&](int sign) {
    return std::all_of(swept.begin(), swept.end(),
                       [&](const Vec& x) { return sign * dot(n, minus(x, polygon[0])) >= 0; });
  };
  if (is_beside(1) || is_beside(-1)) return {};  // on one side of the facet
  for (std::size_t i = 0; i < swept.size(); ++i)
    if (is_outside(swept[i], swept[(i + 1) % 4], swept[(i + 2) % 4], swept[(i + 3) % 4], polygon)) return {};
  std::set<Fraction> times{0, 1};
  const auto note = [&](const Vec& x, const Vec& y, const Vec& z) {
    const Fraction at_0 = volume(from, x, y, z), at_1 = volume(to, x, y, z);
    if (at_0 * at_1 < 0) times.insert(root_of(at_0, at_1));
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    note(q, r, polygon[i]);
    for (std::size_t j = 0; j < i; ++j) {
      note(q, polygon[i], polygon[j]);
      note(r, polygon[i], polygon[j]);
      for (std::size_t l = 0; l < j; ++l) note(polygon[i], polygon[j], polygon[l]);
    }
  }
  const auto at = [&](const Fraction& s) { return Polygon{on(from, to, s), q, r}; };
  for (auto time = times.begin(); *time < 1; ++time) {
    if (*time > 0 && is_overlapped(at(*time), polygon)) return *time;
    if (is_pierced(at((*time + *std::next(time)) / 2), polygon)) return *time;
  }
  return {};
}

}  // namespace cellwalk::test
