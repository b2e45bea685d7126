// SPDX-License-Identifier: LGPL-3.0-or-later
// The first meeting of an edge that turns about its end q with an edge or vertex of an obstacle, in rational
// numbers.
#ifndef CELLWALK_INTERNAL_LCC_OBSTACLE_H
#define CELLWALK_INTERNAL_LCC_OBSTACLE_H

#include <cellwalk/internal/lcc/star.h>
#include <cellwalk/internal/lcc/types.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace cellwalk::lcc::detail {

/// A meeting with the segment from u to v of an obstacle.
struct Meeting {
  Rational time;
  Rational place;  ///< of the point met: 0 at u, 1 at v
};

/// The closed triangle of p at the start a and the end b of its motion, and of q.
template <class Lcc>
class Swept_triangle {
 public:
  static constexpr std::size_t D = static_cast<std::size_t>(Cells<Lcc>::D);
  using Point = typename Lcc::Point;
  using Exact_point = std::array<Rational, D>;

  Swept_triangle(const Point& a, const Point& b, const Point& q)
      : a_(Signs<Lcc>::exact(a)), b_(Signs<Lcc>::exact(b)), q_(Signs<Lcc>::exact(q)) {
    span_ = normal(b_, q_);
    axis_ = 0;
    while (axis_ < span_.size() && CGAL::is_zero(span_[axis_])) ++axis_;
  }

  /// The first meeting with the closed segment uv off the start of the edge: at time 0 if they meet there and
  /// go on to do so. In the plane u and v may be the same.
  /// Degenerate cases: the triangle may be a segment, as may lie in its plane; none if p does not move.
  std::optional<Meeting> first_meeting(const Point& u, const Point& v) const {
    const Exact_point x = Signs<Lcc>::exact(u), y = Signs<Lcc>::exact(v);
    return axis_ == span_.size() ? first_on_line(x, y) : first_in_plane(x, y);
  }

 private:
  /// The parameters of a segment from u, 0, to v, 1.
  struct Part {
    Rational first = 0, last = 1;

    bool empty() const { return first > last; }
    /// Keeps where a function with these values at u and v is >= 0.
    void clip(const Rational& at_u, const Rational& at_v) {
      const Rational slope = at_v - at_u;
      if (CGAL::is_zero(slope)) {
        if (CGAL::is_negative(at_u)) first = Rational(last + 1);
      } else if (CGAL::is_positive(slope)) {
        first = std::max<Rational>(first, Rational(-at_u / slope));
      } else {
        last = std::min<Rational>(last, Rational(-at_u / slope));
      }
    }
  };
  using Normal = std::array<Rational, D == 2 ? 1 : 3>;

  Exact_point from_a(const Exact_point& x) const {
    Exact_point r;
    for (std::size_t i = 0; i < D; ++i) r[i] = x[i] - a_[i];
    return r;
  }
  /// The product of ax and ay: a number in the plane, a vector in space.
  Normal normal(const Exact_point& x, const Exact_point& y) const { return cross(from_a(x), from_a(y)); }
  static Normal cross(const Exact_point& u, const Exact_point& v) {
    if constexpr (D == 2)
      return {u[0] * v[1] - u[1] * v[0]};
    else
      return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }

  std::optional<Meeting> first_in_plane(const Exact_point& u, const Exact_point& v) const {
    Part part;
    if constexpr (D == 3) {
      const auto height = [&](const Exact_point& x) {
        const Exact_point r = from_a(x);
        return Rational(span_[0] * r[0] + span_[1] * r[1] + span_[2] * r[2]);
      };
      const Rational at_u = height(u), at_v = height(v);
      part.clip(at_u, at_v);
      part.clip(-at_u, -at_v);
    }
    // Weights of b and q, as functions on space that are right in the plane; that of a is what remains.
    const auto weight_of_b = [&](const Exact_point& x) {
      return Rational(normal(x, q_)[axis_] / span_[axis_]);
    };
    const auto weight_of_q = [&](const Exact_point& x) {
      return Rational(normal(b_, x)[axis_] / span_[axis_]);
    };
    const Rational bu = weight_of_b(u), bv = weight_of_b(v), qu = weight_of_q(u), qv = weight_of_q(v);
    if (!part.empty()) part.clip(bu, bv);
    if (!part.empty()) part.clip(qu, qv);
    if (!part.empty()) part.clip(Rational(1 - bu - qu), Rational(1 - bv - qv));
    if (part.empty()) return {};
    std::optional<Meeting> first;
    bool goes_on = false;
    for (const Rational& place : {part.first, part.last}) {
      const Rational off_q = 1 - (qu + place * (qv - qu));
      if (CGAL::is_zero(off_q)) continue;  // the edge never leaves q
      const Rational time = (bu + place * (bv - bu)) / off_q;
      goes_on |= CGAL::is_positive(time);
      if (!first || time < first->time) first = Meeting{time, place};
    }
    return goes_on ? first : std::nullopt;
  }

  /// p moves in the line of the edge: it sweeps the part of its way that the edge did not contain.
  std::optional<Meeting> first_on_line(const Exact_point& u, const Exact_point& v) const {
    std::size_t axis = 0;
    while (axis < D && a_[axis] == b_[axis]) ++axis;
    if (axis == D) return {};
    const auto time_of = [&](const Exact_point& x) {
      return Rational((x[axis] - a_[axis]) / (b_[axis] - a_[axis]));
    };
    const Rational begin = std::max<Rational>(time_of(q_), 0);
    // Where uv meets the line, its product with the direction is 0.
    const Exact_point way = from_a(b_);
    const Normal at_u = cross(from_a(u), way), at_v = cross(from_a(v), way);
    Part part;
    for (std::size_t i = 0; i < at_u.size() && !part.empty(); ++i) {
      part.clip(at_u[i], at_v[i]);
      if (!part.empty()) part.clip(-at_u[i], -at_v[i]);
    }
    if (part.empty()) return {};
    const Rational at_u_time = time_of(u), slope = time_of(v) - at_u_time;
    const Rational one = at_u_time + part.first * slope, other = at_u_time + part.last * slope;
    const Rational first = std::max<Rational>(begin, std::min<Rational>(one, other));
    const Rational last = std::min<Rational>(1, std::max<Rational>(one, other));
    if (first > last || last <= begin) return {};  // always, if the edge gets shorter
    return Meeting{first, CGAL::is_zero(slope) ? part.first : Rational((first - at_u_time) / slope)};
  }

  const Exact_point a_, b_, q_;
  Normal span_;       ///< the product of ab and aq
  std::size_t axis_;  ///< a component of it that is not 0, or past the last one
};

/// The unit normal of a contact of an edge with an edge or vertex of an obstacle, rounded, against the
/// motion: perpendicular to both; if they are parallel that of the wall; else the reversed motion, across the
/// edge if it can be.
template <class Lcc>
auto normal_of_meeting(const Signs<Lcc>& signs, const Contact<Lcc>& contact, const typename Lcc::Point& a,
                       const typename Lcc::Point& b, const typename Lcc::Point& q) {
  constexpr std::size_t D = Swept_triangle<Lcc>::D;
  using Vector = std::array<double, D>;
  const auto dot = [](const Vector& u, const Vector& v) {
    double sum = 0;
    for (std::size_t i = 0; i < D; ++i) sum += u[i] * v[i];
    return sum;
  };
  // From one point to another at most one long in each coordinate, whatever their scale.
  const auto unit = [&](const auto& from, const auto& to) {
    std::array<Rational, D> way;
    Rational largest = 0;
    for (std::size_t i = 0; i < D; ++i) {
      way[i] = to[i] - from[i];
      largest = std::max<Rational>(largest, CGAL::abs(way[i]));
    }
    Vector v{};
    if (CGAL::is_zero(largest)) return v;
    for (std::size_t i = 0; i < D; ++i) v[i] = CGAL::to_double(Rational(way[i] / largest));
    const double length = std::sqrt(dot(v, v));
    for (double& x : v) x /= length;
    return v;
  };
  const auto start = Signs<Lcc>::exact(a), end = Signs<Lcc>::exact(b);
  auto p = start;
  for (std::size_t i = 0; i < D; ++i) p[i] += contact.time * (end[i] - start[i]);
  const Vector back = unit(end, start), edge = unit(p, Signs<Lcc>::exact(q));
  constexpr double parallel = 0x1p-40;  // sines and cosines below it are due to rounding
  const auto is_against = [&](const Vector& v) { return dot(v, back) > parallel; };
  const auto across_edge = [&](Vector v) {
    const double along = dot(v, edge);
    for (std::size_t i = 0; i < D; ++i) v[i] -= along * edge[i];
    return v;
  };
  Vector normal = across_edge(back);
  if constexpr (D == 3)
    if (contact.dimension == 1) {
      const Vector other = unit(Signs<Lcc>::exact(signs.cells().point(contact.feature)),
                                Signs<Lcc>::exact(signs.cells().end(contact.feature)));
      normal = {edge[1] * other[2] - edge[2] * other[1], edge[2] * other[0] - edge[0] * other[2],
                edge[0] * other[1] - edge[1] * other[0]};
    }
  for (const Vector& v : {normal, across_edge(back)}) {
    const double length = std::sqrt(dot(v, v)), sign = dot(v, back) < 0 ? -1 : 1;
    Vector scaled = v;
    for (double& x : scaled) x *= sign / length;
    if (length > parallel && is_against(scaled)) return scaled;
    if (const Vector wall = inner_normal(signs, contact.wall); is_against(wall)) return wall;
  }
  return back;
}

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_OBSTACLE_H
