// SPDX-License-Identifier: LGPL-3.0-or-later
// Separating planes first, then facets clipped in volume coordinates, for the first touch.
#include "swept_tetrahedron.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::detail {
namespace {

/// The corners with one of them replaced.
Corners with(const Corners& corners, std::size_t k, const Point<3>& x) {
  Corners result = corners;
  result[k] = x;
  return result;
}

Ring volume(const Corners& c) { return Exact_value::orientation(c[0], c[1], c[2], c[3]); }

/// Keeps the part of a convex polygon in which volume k is not negative.
std::vector<Volumes> clipped(const std::vector<Volumes>& polygon, std::size_t k) {
  std::vector<Volumes> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Volumes &u = polygon[i], &v = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const int at_u = CGAL::sign(u[k]), at_v = CGAL::sign(v[k]);
    if (at_u >= 0) result.push_back(u);
    if (at_u * at_v >= 0) continue;
    const Volumes &inside = at_u > 0 ? u : v, &outside = at_u > 0 ? v : u;
    Volumes x;
    for (std::size_t j = 0; j < 4; ++j) x[j] = outside[j] * inside[k] - inside[j] * outside[k];
    result.push_back(x);
  }
  return result;
}

Exact_point<3> point_of(const Volumes& volumes, const Corners& corners) {
  Exact_point<3> x;
  x.denominator = volumes[0] + volumes[1] + volumes[2] + volumes[3];
  for (std::size_t i = 0; i < 3; ++i) {
    x.numerator[i] = 0;
    for (std::size_t k = 0; k < 4; ++k) x.numerator[i] += volumes[k] * Ring(corners[k][i]);
  }
  return x;
}

}  // namespace

std::vector<Volumes> clip(const Cell_view<3>& cell, std::size_t i, const Corners& corners) {
  const bool is_negative = CGAL::sign(volume(corners)) == CGAL::NEGATIVE;
  std::vector<Volumes> polygon;
  for (const std::uint16_t v : cell.loop(i)) {
    Volumes volumes;
    for (std::size_t k = 0; k < 4; ++k) {
      volumes[k] = volume(with(corners, k, cell.point(v)));
      if (is_negative) volumes[k] = -volumes[k];
    }
    polygon.push_back(volumes);
  }
  for (std::size_t k = 0; k < 4; ++k) polygon = clipped(polygon, k);
  return polygon;
}

bool reaches_inside(const std::vector<Volumes>& polygon) {
  for (std::size_t k = 0; k < 4; ++k)
    if (std::all_of(polygon.begin(), polygon.end(), [k](const Volumes& v) { return CGAL::is_zero(v[k]); }))
      return false;
  return true;
}

Swept_tetrahedron::Swept_tetrahedron(const Corners& corners, Face_counts& counts)
    : corners_(corners),
      counts_(counts),
      sense_(Exact::orientation(counts.walk.predicates, corners[0], corners[1], corners[2], corners[3])) {}

int Swept_tetrahedron::sign(std::size_t corner, const Point<3>& x) const {
  const Corners c = with(corners_, corner, x);
  return sense_ * Exact::orientation(counts_.walk.predicates, c[0], c[1], c[2], c[3]);
}

bool Swept_tetrahedron::meets(const Cell_view<3>& cell, std::size_t i) const {
  bool is_before = false, is_behind = false;
  for (const Point<3>& corner : corners_) {
    const int s = side<Exact>(cell, i, corner, counts_.walk);
    is_before |= s < 0;
    is_behind |= s > 0;
  }
  if (!is_before || !is_behind) return false;
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < 4; ++k)
    if (std::none_of(loop.begin(), loop.end(), [&](std::uint16_t v) { return sign(k, cell.point(v)) > 0; }))
      return false;
  return !is_parted_at_edge(cell, i);
}

/// True if a plane through an edge of the tetrahedron and a vertex of the facet has them on different sides.
bool Swept_tetrahedron::is_parted_at_edge(const Cell_view<3>& cell, std::size_t i) const {
  const auto loop = cell.loop(i);
  for (std::size_t e = 0; e < 4; ++e) {
    for (std::size_t f = e + 1; f < 4; ++f) {
      // The edge is cd; e and f are the other corners. It starts at the corner that does not move, if there
      // is one: the target may be so far away that differences from it lose the other points.
      const std::size_t low = e == 0 ? (f == 1 ? 2 : 1) : 0, high = 6 - low - e - f;
      const std::size_t c = low == 1 ? high : low, d = low == 1 ? low : high;
      for (const std::uint16_t u : loop) {
        const auto beside = [&](const Point<3>& x) {
          return Exact::orientation(counts_.walk.predicates, corners_[c], corners_[d], cell.point(u), x);
        };
        const int at_e = beside(corners_[e]), at_f = beside(corners_[f]);
        const int own = at_e != 0 ? at_e : at_f;
        if (own == 0 || at_e * at_f < 0) continue;
        if (std::none_of(loop.begin(), loop.end(),
                         [&](std::uint16_t w) { return w != u && own * beside(cell.point(w)) > 0; }))
          return true;
      }
    }
  }
  return false;
}

Swept_tetrahedron::Touch Swept_tetrahedron::first_touch(const Cell_view<3>& cell, std::size_t i) const {
  ++counts_.clipped;
  std::optional<Touch> first;
  for (const Volumes& x : clip(cell, i, corners_)) {
    const Ring moving = x[0] + x[1];
    if (CGAL::is_zero(moving)) continue;
    const Fraction time(x[1], moving);
    if (first && first->time < time) continue;
    const Exact_point<3> point = point_of(x, corners_);
    const Facet_feature feature = lowest_feature<3>(cell, i, point);
    if (first && first->time == time && first->feature.kind <= feature.kind) continue;
    const int sides = int{CGAL::is_zero(x[2])} + int{CGAL::is_zero(x[3])};
    first = Touch{time, point, feature,
                  sides == 0   ? Body_feature::face
                  : sides == 1 ? Body_feature::edge
                               : Body_feature::vertex};
  }
  return *first;
}

Vector<3> Swept_tetrahedron::normal_at(const Fraction& time) const {
  const Exact_point<3> p = Rational_segment<3>(corners_[0], corners_[1]).at(time);
  // The vectors from p to q and r, times a positive number.
  const Ring_vector<3> u = negative(p.from(exact<3>(corners_[2]))),
                       v = negative(p.from(exact<3>(corners_[3])));
  const Ring_vector<3> n = exact_cross(u, v);
  Ring largest = 0;
  for (const Ring& x : n) largest = std::max<Ring>(largest, CGAL::abs(x));
  if (CGAL::sign(exact_dot(n, minus(exact<3>(corners_[0]), exact<3>(corners_[1])))) == CGAL::NEGATIVE)
    largest = -largest;
  Vector<3> normal;
  for (std::size_t i = 0; i < 3; ++i) normal[i] = to_double(Fraction(n[i], largest));
  const double size = length(normal);
  for (double& x : normal) x = x / size + 0.0;  // no negative zeros for readers of tables
  return normal;
}

}  // namespace cellwalk::detail
