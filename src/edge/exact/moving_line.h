// SPDX-License-Identifier: LGPL-3.0-or-later
// The segment from a moving point p(s) = a + s (b - a) to a fixed one, just after a time. Theory:
// docs/sweep.md, events.
#ifndef CELLWALK_EDGE_EXACT_MOVING_LINE_H
#define CELLWALK_EDGE_EXACT_MOVING_LINE_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <cstddef>

#include "event_time.h"

namespace cellwalk::detail {

/// The side of facet i on which a point lies that moves from a to b.
template <int D>
Moving_orientation<D> moving_side(const Cell_view<D>& cell, std::size_t i, const Point<D>& a,
                                  const Point<D>& b, Walk_counts& counts) {
  ++counts.side_tests;
  const auto loop = cell.loop(i);
  const auto fixed = [&]() -> typename Moving_orientation<D>::Fixed {
    if constexpr (D == 2)
      return {cell.point(loop[0]), cell.point(loop[1])};
    else
      return {cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2])};
  };
  return {a, b, fixed(), -1, counts.predicates};
}

/// The line from p(s) to q just after time s, with the interface of exit_through(), and its sign functions.
template <int D>
class Moving_line {
 public:
  Moving_line(const Swept_triangle<D>& triangle, const Event_time<D>& s, Walk_counts& counts)
      : triangle_(triangle), s_(s), counts_(counts) {}

  int along(const Cell_view<D>& cell, std::size_t i, std::size_t k) const {
    return s_.sign_after(along_of(cell, i, k));
  }
  int across(const Point<D>& v, const Point<D>& w) const {
    return s_.sign_after(function({triangle_.q, v, w}));
  }

  /// The line with respect to ridge k of facet i.
  Moving_orientation<D> along_of(const Cell_view<D>& cell, std::size_t i, std::size_t k) const {
    ++counts_.along_tests;
    const auto loop = cell.loop(i);
    if constexpr (D == 2)
      return function({triangle_.q, cell.point(loop[k])}, k == 0 ? -1 : 1);
    else
      return against(cell.point(loop[k]), cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]));
  }
  /// The line with respect to the line uv, or in 2D the point u = v.
  Moving_orientation<D> against(const Point<D>& u, const Point<D>& v) const {
    if constexpr (D == 2)
      return function({triangle_.q, u});
    else
      return function({triangle_.q, u, v});
  }
  /// p(s) with respect to facet i.
  Moving_orientation<D> side_of(const Cell_view<D>& cell, std::size_t i) const {
    return moving_side<D>(cell, i, triangle_.a, triangle_.b, counts_);
  }

  /// Calls note(time) for the times after this one at which a sign changes that determines whether and how
  /// the segment passes facet i.
  template <class Note>
  void for_all_roots(const Cell_view<D>& cell, std::size_t i, Note note) const {
    const auto note_root = [&](const Moving_orientation<D>& f) {
      if (f.has_root() && s_.sign_after(f) != f.at_1()) note(Event_time<D>::root_of(f));
    };
    note_root(side_of(cell, i));
    const auto loop = cell.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) note_root(along_of(cell, i, k));
    if constexpr (D == 3) {
      if (!holds_triangle(cell, i)) return;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Point<D>&u = cell.point(loop[k]), &v = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
        note_root_in_plane(triangle_.q, u, note);
        note_root_in_plane(u, v, note);
      }
    }
  }

  /// True if the whole triangle lies in the plane of facet i.
  bool holds_triangle(const Cell_view<D>& cell, std::size_t i) const {
    return detail::side<Exact>(cell, i, triangle_.q, counts_) == 0 &&
           detail::side<Exact>(cell, i, triangle_.a, counts_) == 0 &&
           detail::side<Exact>(cell, i, triangle_.b, counts_) == 0;
  }

  const Swept_triangle<D>& triangle() const { return triangle_; }
  const Event_time<D>& time() const { return s_; }
  Walk_counts& counts() const { return counts_; }

 private:
  static Point<2> drop(const Point<D>& x, int axis) { return {x[(axis + 1) % 3], x[(axis + 2) % 3]}; }

  Moving_orientation<D> function(const typename Moving_orientation<D>::Fixed& fixed, int sense = 1) const {
    return {triangle_.a, triangle_.b, fixed, sense, counts_.predicates};
  }

  /// The same if the plane of the facet contains the whole triangle: p(s) and two points of the plane are
  /// projected along an axis along which the triangle has a positive area.
  template <class Note>
  void note_root_in_plane(const Point<D>& x, const Point<D>& y, Note note) const {
    int axis = 0;
    while (axis < 2 && Exact::orientation(counts_.predicates, drop(triangle_.a, axis),
                                          drop(triangle_.b, axis), drop(triangle_.q, axis)) == 0)
      ++axis;
    const Moving_orientation<2> f(drop(triangle_.a, axis), drop(triangle_.b, axis),
                                  {drop(x, axis), drop(y, axis)}, 1, counts_.predicates);
    if (!f.has_root()) return;
    const Event_time<D> root(f.root());
    if (s_ < root) note(root);
  }

  const Swept_triangle<D>& triangle_;
  const Event_time<D>& s_;
  Walk_counts& counts_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_EXACT_MOVING_LINE_H
