// SPDX-License-Identifier: LGPL-3.0-or-later
// All walls of a snapshot as closed sets, against which segments and triangles are held in rational
// arithmetic, one by one.
#ifndef CELLWALK_TESTS_BODY_CLOSED_WALLS_H
#define CELLWALK_TESTS_BODY_CLOSED_WALLS_H

#include <cellwalk/environment/snapshot.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <vector>

#include "edge/rational_touch.h"

namespace cellwalk::test {

/// \pre walls are planar
template <int D>
class Closed_walls {
 public:
  explicit Closed_walls(const Snapshot<D>& snapshot) {
    for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
      const Cell cell = snapshot.cell(i);
      if (snapshot.is_solid(cell)) continue;
      for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k)
        if (const Half_facet f = snapshot.half_facet(cell, k); snapshot.is_impassable(f)) add(snapshot, f);
    }
  }

  bool meet_segment(const Point<D>& a, const Point<D>& b) const {
    return meet({a, b}, [&](std::span<const Point<3>> wall) {
      return segment_meets(in_space(a), in_space(b), wall);
    });
  }
  bool meet_triangle(const Point<D>& a, const Point<D>& b, const Point<D>& q) const {
    return meet({a, b, q}, [&](std::span<const Point<3>> wall) {
      return touch_of_edge(in_space(a), in_space(b), in_space(q), wall).any();
    });
  }

 private:
  /// A wall of the plane as it is, one of space as the triangles of a fan.
  struct Piece {
    std::array<Point<3>, D> points;
    Point<3> low, high;
  };

  static Point<3> in_space(const Point<D>& x) {
    Point<3> y{};
    std::copy(x.begin(), x.end(), y.begin());
    return y;
  }

  void add(const Snapshot<D>& snapshot, Half_facet f) {
    const auto loop = snapshot.loop(f);
    for (std::size_t i = D - 1; i < loop.size(); ++i) {
      Piece& piece = pieces_.emplace_back();
      for (std::size_t k = 0; k < D; ++k)
        piece.points[k] = in_space(snapshot.point(loop[k == 0 ? 0 : i + k + 1 - D]));
      piece.low = piece.high = piece.points[0];
      for (const Point<3>& x : piece.points)
        for (std::size_t k = 0; k < 3; ++k) {
          piece.low[k] = std::min(piece.low[k], x[k]);
          piece.high[k] = std::max(piece.high[k], x[k]);
        }
    }
  }

  template <class Meets>
  bool meet(std::initializer_list<Point<D>> points, const Meets& meets) const {
    return std::ranges::any_of(pieces_, [&](const Piece& piece) {
      for (std::size_t k = 0; k < D; ++k) {
        const auto [least, most] = std::minmax_element(
            points.begin(), points.end(), [k](const Point<D>& x, const Point<D>& y) { return x[k] < y[k]; });
        if ((*most)[k] < piece.low[k] || (*least)[k] > piece.high[k]) return false;
      }
      return meets(piece.points);
    });
  }

  std::vector<Piece> pieces_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_CLOSED_WALLS_H
