// SPDX-License-Identifier: LGPL-3.0-or-later
// The segment from a moving point p(s) = a + s (b - a) to a fixed one, just after a time. Theory: docs/sweep.md, events.
#ifndef CELLWALK_EDGE_MOVING_LINE_H
#define CELLWALK_EDGE_MOVING_LINE_H

#include <cellwalk/edge/flood.h>
#include <cellwalk/kernel/exact_value.h>
#include <cellwalk/walk/detail/signs.h>

#include <optional>
#include <utility>

namespace cellwalk::detail {

/// A function that is affine in s, by its signs at 0 and 1 and, where these do not tell, its values there.
template <class Values>
struct Affine {
  int at_0, at_1;
  Values values;  ///< returns the pair of values

  /// The sign just after s < 1: that of the value, or where that is 0, that of the value at 1.
  int sign_after(const Rational& s) const {
    if (at_0 == at_1 || at_1 == 0) return at_0;
    if (at_0 == 0) return at_1;
    if (CGAL::is_zero(s)) return at_0;
    const auto [v_0, v_1] = values();
    const int sign = CGAL::sign(Rational(v_0 + s * (v_1 - v_0)));
    return sign != 0 ? sign : at_1;
  }

  /// The time after s at which the sign changes, if it does.
  std::optional<Rational> root_after(const Rational& s) const {
    if (at_0 * at_1 >= 0 || sign_after(s) == at_1) return {};
    const auto [v_0, v_1] = values();
    return Rational(v_0 / (v_0 - v_1));
  }
};

/// The line from p(s) to q just after time s, as exit_through() sees lines, and the functions behind it.
template <int D>
class Moving_line {
 public:
  Moving_line(const Swept_triangle<D>& triangle, const Rational& s, Walk_counts& counts)
      : triangle_(triangle), s_(s), counts_(counts) {}

  int along(const Cell_view<D>& cell, std::size_t i, std::size_t k) const {
    return along_of(cell, i, k).sign_after(s_);
  }
  int across(const Point<D>& v, const Point<D>& w) const {
    return affine([&](auto kernel, const Point<D>& p) {
             return decltype(kernel)::orientation(counts_.predicates, p, triangle_.q, v, w);
           })
        .sign_after(s_);
  }

  /// The line against ridge k of facet i.
  auto along_of(const Cell_view<D>& cell, std::size_t i, std::size_t k) const {
    return affine([this, cell, i, k](auto kernel, const Point<D>& p) {
      return detail::along<decltype(kernel)>(cell, i, k, p, triangle_.q, counts_);
    });
  }
  /// p(s) against facet i.
  auto side_of(const Cell_view<D>& cell, std::size_t i) const {
    return affine([this, cell, i](auto kernel, const Point<D>& p) {
      return detail::side<decltype(kernel)>(cell, i, p, counts_);
    });
  }

  /// All functions whose roots change how the segment passes facet i, or that it does.
  template <class Note>
  void for_all_functions(const Cell_view<D>& cell, std::size_t i, Note note) const {
    note(side_of(cell, i));
    const auto loop = cell.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) note(along_of(cell, i, k));
    if constexpr (D == 3) {
      if (!holds_triangle(cell, i)) return;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point<D>&u = cell.point(loop[k]), &v = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
        note(in_plane_of(triangle_.q, u));
        note(in_plane_of(u, v));
      }
    }
  }

  /// True if the whole triangle lies in the plane of facet i.
  bool holds_triangle(const Cell_view<D>& cell, std::size_t i) const {
    return detail::side<Exact>(cell, i, triangle_.q, counts_) == 0 &&
           detail::side<Exact>(cell, i, triangle_.a, counts_) == 0 &&
           detail::side<Exact>(cell, i, triangle_.b, counts_) == 0;
  }

  /// In a plane that holds the whole triangle: p(s) and two points of it, seen along an axis along which the triangle has an
  /// area. 3D only.
  auto in_plane_of(const Point<D>& x, const Point<D>& y) const {
    int axis = 0;
    while (axis < 2 && Exact::orientation(counts_.predicates, drop(triangle_.a, axis),
                                          drop(triangle_.b, axis), drop(triangle_.q, axis)) == 0)
      ++axis;
    return affine([this, x, y, axis](auto kernel, const Point<D>& p) {
      return decltype(kernel)::orientation(counts_.predicates, drop(p, axis), drop(x, axis), drop(y, axis));
    });
  }

  const Swept_triangle<D>& triangle() const { return triangle_; }
  const Rational& time() const { return s_; }
  Walk_counts& counts() const { return counts_; }

 private:
  static Point<2> drop(const Point<D>& x, int axis) { return {x[(axis + 1) % 3], x[(axis + 2) % 3]}; }

  template <class Value>
  auto affine(Value value) const {
    const auto values = [this, value] {
      return std::pair<Rational, Rational>(value(Exact_value{}, triangle_.a),
                                           value(Exact_value{}, triangle_.b));
    };
    return Affine<decltype(values)>{value(Exact{}, triangle_.a), value(Exact{}, triangle_.b), values};
  }

  const Swept_triangle<D>& triangle_;
  const Rational& s_;
  Walk_counts& counts_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_MOVING_LINE_H
