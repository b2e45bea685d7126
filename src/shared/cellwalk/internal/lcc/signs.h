// SPDX-License-Identifier: LGPL-3.0-or-later
// The signs of the walk on a map, by the predicates of the map's own kernel, and exact times by rational
// numbers.
#ifndef CELLWALK_INTERNAL_LCC_SIGNS_H
#define CELLWALK_INTERNAL_LCC_SIGNS_H

#include <cellwalk/internal/lcc/cells.h>
#include <cellwalk/kernel/point.h>  // refuses -ffast-math

#include <CGAL/Exact_rational.h>
#include <CGAL/Kernel/global_functions.h>
#include <CGAL/determinant.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace cellwalk::lcc {

/// Counts of walks on a map. They do not depend on the machine.
struct Counts {
  std::uint64_t walks = 0;
  std::uint64_t crossings = 0;  ///< facets, ridges and vertices passed
  std::uint64_t turns = 0;      ///< steps from facet to facet of the predictive simplex
  std::uint64_t signs = 0;      ///< predicates evaluated
  std::uint64_t rules = 0;      ///< cells that the predictive simplex left to the rule of exits
  std::uint64_t stars = 0;      ///< searches of the star of a ridge or vertex
};

/// A share of a motion: exact where coordinates are.
using Rational = CGAL::Exact_rational;

namespace detail {

template <class Number>
Rational to_rational(const Number& x) {
  if constexpr (std::is_convertible_v<Number, Rational>)
    return Rational(x);
  else
    return Rational(CGAL::exact(x));
}

/// The signs of a map whose facets are seen counterclockwise from outside (orientation 1) or inside (-1) of
/// their cells.
template <class Lcc>
class Signs {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;
  using Exact_point = std::array<Rational, static_cast<std::size_t>(D)>;

  Signs(const Cells<Lcc>& cells, int orientation, Counts& counts)
      : cells_(cells), orientation_(orientation), counts_(counts) {}

  const Cells<Lcc>& cells() const { return cells_; }
  int map_orientation() const { return orientation_; }
  Counts& counts() const { return counts_; }

  /// The side of x with respect to a facet: > 0 strictly outside the cell.
  int side(Dart_of facet, const Point& x) const {
    if constexpr (D == 2) {
      ++counts_.signs;
      return -orientation_ * CGAL::orientation(cells_.point(facet), cells_.end(facet), x);
    } else {
      const Point &p = cells_.point(facet), &q = cells_.end(facet);
      // Only where the sign is 0 the three corners may be collinear; then another one is taken.
      for (Dart_of e = cells_.next(cells_.next(facet)); e != facet; e = cells_.next(e)) {
        ++counts_.signs;
        const int sign = orientation_ * CGAL::orientation(p, q, cells_.point(e), x);
        if (sign != 0 || cells_.next(e) == facet || !are_collinear(p, q, cells_.point(e))) return sign;
      }
      return 0;
    }
  }

  /// The sign of the line ab with respect to an edge of a facet (3D), or an end of it (2D): the first one, or
  /// the second. A line that leaves the cell through the facet has no negative sign.
  int along(const Point& a, const Point& b, Dart_of d, bool second = false) const {
    ++counts_.signs;
    if constexpr (D == 2) {
      const int sign = orientation_ * CGAL::orientation(a, b, second ? cells_.end(d) : cells_.point(d));
      return second ? sign : -sign;
    } else {
      return orientation_ * CGAL::orientation(a, b, cells_.point(d), cells_.end(d));
    }
  }

  /// The orientation of points, whatever that of the map.
  template <class... P>
  int orientation(const P&... points) const {
    ++counts_.signs;
    return CGAL::orientation(points...);
  }
  bool are_collinear(const Point& p, const Point& q, const Point& r) const {
    ++counts_.signs;
    return CGAL::collinear(p, q, r);
  }
  /// True if x lies on the closed segment uv.
  bool on_segment(const Point& u, const Point& v, const Point& x) const {
    return are_collinear(u, x, v) && CGAL::collinear_are_ordered_along_line(u, x, v);
  }

  /// Three corners of a facet (2D: two) that span it.
  std::array<const Point*, static_cast<std::size_t>(D)> spanning(Dart_of facet) const {
    const Point &p = cells_.point(facet), &q = cells_.end(facet);
    if constexpr (D == 2) {
      return {&p, &q};
    } else {
      Dart_of e = cells_.next(cells_.next(facet));
      while (cells_.next(e) != facet && are_collinear(p, q, cells_.point(e))) e = cells_.next(e);
      return {&p, &q, &cells_.point(e)};
    }
  }

  /// A vertex of a facet's cell that does not lie in its plane; null by rounded signs only.
  /// \param facets a dart of each facet of the cell
  const Point* off_plane(Dart_of facet, const typename Cells<Lcc>::Darts& facets) const {
    const Point* off = nullptr;
    cells_.for_each_point(facets, [&](const Point& x) {
      if (side(facet, x) != 0) off = &x;
      return !off;
    });
    return off;
  }

  /// The side of a facet on which a point of it lies after a displacement by (e, e^2, e^3), for all small e >
  /// 0: > 0 outside the cell.
  int displaced_side(Dart_of facet) const {
    const auto p = spanning(facet);
    if constexpr (D == 2)
      return -orientation_ * displaced_side(*p[0], *p[1]);
    else
      return orientation_ * displaced_side(*p[0], *p[1], *p[2]);
  }
  /// The same for a plane or line through points: the sign of the first component of its normal that is not
  /// 0.
  int displaced_side(const Point& p, const Point& q) const {
    const int y = CGAL::compare(p.y(), q.y());
    return y != 0 ? y : static_cast<int>(CGAL::compare(q.x(), p.x()));
  }
  int displaced_side(const Point& p, const Point& q, const Point& r) const {
    using Point_2 = typename Lcc::Traits::Point_2;
    for (int axis = 0; axis < 3; ++axis) {
      const auto flat = [&](const Point& x) { return Point_2(x[(axis + 1) % 3], x[(axis + 2) % 3]); };
      if (const int sign = orientation(flat(p), flat(q), flat(r))) return sign;
    }
    return 0;
  }

  static Exact_point exact(const Point& p) {
    Exact_point x;
    for (int i = 0; i < D; ++i) x[static_cast<std::size_t>(i)] = to_rational(p[i]);
    return x;
  }
  /// The orientation of points as a number.
  static Rational value(const Point& p, const Point& q, const Point& r) {
    const auto a = exact(p), b = exact(q), c = exact(r);
    return CGAL::determinant<Rational>(b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]);
  }
  static Rational value(const Point& p, const Point& q, const Point& r, const Point& s) {
    const auto a = exact(p), b = exact(q), c = exact(r), d = exact(s);
    return CGAL::determinant<Rational>(b[0] - a[0], b[1] - a[1], b[2] - a[2], c[0] - a[0], c[1] - a[1],
                                       c[2] - a[2], d[0] - a[0], d[1] - a[1], d[2] - a[2]);
  }

  /// A normal of a facet, of some length, on the side of its cell.
  Exact_point exact_normal(Dart_of facet) const {
    const auto corners = spanning(facet);
    const auto o = exact(*corners[0]);
    const auto span = [&](std::size_t k) {
      auto x = exact(*corners[k]);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= o[i];
      return x;
    };
    const auto u = span(1);
    Exact_point n;
    if constexpr (D == 2) {
      n = {-u[1], u[0]};
    } else {
      const auto v = span(2);
      n = {v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]};
    }
    for (Rational& x : n) x *= orientation_;
    return n;
  }

  /// When the motion from a to b meets the plane of a facet, if it is not parallel to it.
  std::optional<Rational> time_at(Dart_of facet, const Point& a, const Point& b) const {
    const auto p = spanning(facet);
    if constexpr (D == 2)
      return root(value(*p[0], *p[1], a), value(*p[0], *p[1], b));
    else
      return root(value(*p[0], *p[1], *p[2], a), value(*p[0], *p[1], *p[2], b));
  }
  /// When a motion passes the line of an edge that it meets in one point.
  std::optional<Rational> time_at(const Point& u, const Point& v, const Point& a, const Point& b) const {
    static_assert(D == 3);
    using Number = typename Lcc::FT;
    // Any plane through the edge that does not contain the motion gives it.
    for (int axis = 0; axis < 3; ++axis) {
      const auto other = [&](int i) -> Number { return i != axis ? u[i] : Number(CGAL::is_zero(u[i])); };
      const Point beside(other(0), other(1), other(2));
      if (const auto t = root(value(u, v, beside, a), value(u, v, beside, b))) return t;
    }
    return {};
  }
  /// When a motion passes a point of its line.
  std::optional<Rational> time_at(const Point& x, const Point& a, const Point& b) const {
    for (int i = 0; i < D; ++i)
      if (a[i] != b[i])
        return Rational((to_rational(x[i]) - to_rational(a[i])) / (to_rational(b[i]) - to_rational(a[i])));
    return {};
  }

 private:
  static std::optional<Rational> root(const Rational& at_a, const Rational& at_b) {
    const Rational span = at_a - at_b;
    if (CGAL::is_zero(span)) return {};
    return Rational(at_a / span);
  }

  const Cells<Lcc>& cells_;
  int orientation_;
  Counts& counts_;
};

}  // namespace detail
}  // namespace cellwalk::lcc

#endif  // CELLWALK_INTERNAL_LCC_SIGNS_H
