// SPDX-License-Identifier: LGPL-3.0-or-later
// The exit of a motion from a cell of a map: by the predictive simplex of the paper, and by the rule that
// decides degenerate cases. Theory: docs/walk.md, the rule.
#ifndef CELLWALK_INTERNAL_LCC_EXIT_H
#define CELLWALK_INTERNAL_LCC_EXIT_H

#include <cellwalk/internal/lcc/signs.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk::lcc::detail {

/// The exit of a motion from a cell. The dart is one of the facet, or that of the ridge or vertex.
template <class Lcc>
struct Exit {
  enum Kind : std::uint8_t { arrived, facet, ridge, vertex, none } kind = none;
  Dart<Lcc> dart{};
  std::optional<Rational> time{};  ///< of places in the boundary

  bool is_at_feature() const { return kind == ridge || kind == vertex; }
  Feature<Lcc> feature() const { return {dart, kind == vertex}; }
};

template <class Lcc>
class Exit_finder {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;
  using Exit_of = Exit<Lcc>;

  Exit_finder(const Signs<Lcc>& signs, const Point& a, const Point& b)
      : signs_(signs), cells_(signs.cells()), a_(a), b_(b) {}

  /// The paper's forecast: turn from facet to facet across the ridge that the target lies beyond, until it
  /// lies in the cone of the facet over the start. Nothing where a sign is 0 or the turns do not end.
  /// \param aimed a dart of the facet to begin with; afterwards of the last one
  std::optional<Exit_of> by_simplex(Dart_of& aimed) const {
    // The cone of a facet is over the start only if that lies strictly on its inner side.
    const Dart_of first = aimed;
    for (int k = 0; signs_.side(aimed, a_) >= 0; ++k) {
      aimed = D == 2 ? cells_.next(aimed) : neighbouring(aimed, k % 2 == 0);
      if (k == most_turns || aimed == first) return {};
    }
    for (int turns = 0; turns < most_turns; ++turns) {
      std::optional<Dart_of> next;
      bool is_degenerate = false;
      const auto test = [&](Dart_of d, bool second) {
        if (next || is_degenerate) return;
        const int sign = signs_.along(a_, b_, d, second);
        is_degenerate = sign == 0;
        if (sign < 0) next = D == 3 ? cells_.across_edge(d) : second ? cells_.next(d) : cells_.previous(d);
      };
      cells_.for_each_dart(aimed, [&](Dart_of d) {
        test(d, false);
        if (D == 2) test(d, true);
      });
      if (is_degenerate) return {};
      if (!next) {
        const int side = signs_.side(aimed, b_);
        if (side == 0) return {};
        return Exit_of{side < 0 ? Exit_of::arrived : Exit_of::facet, aimed};
      }
      ++signs_.counts().turns;
      aimed = *next;
    }
    return {};
  }

  /// The exit by the sides of all facets of a cell.
  /// \param facets a dart of each
  /// \param sides those of the target
  Exit_of by_rule(const typename Cells<Lcc>::Darts& facets,
                  const boost::container::small_vector<std::int8_t, 16>& sides) const {
    bool is_outside = false;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (sides[i] <= 0) continue;
      is_outside = true;
      if (const Exit_of exit = through(facets[i]); exit.kind != Exit_of::none) return exit;
    }
    return {is_outside ? Exit_of::none : Exit_of::arrived, facets.front()};
  }

 private:
  /// Beyond it, a cell is left to the rule: turns among coplanar facets need not end.
  static constexpr int most_turns = 256;

  /// A dart of the facet across an edge. Turned to either side in turn, one passes all facets of a simplex or
  /// cube.
  Dart_of neighbouring(Dart_of d, bool turns_left) const {
    if constexpr (D == 2) return d;
    const Dart_of other = cells_.across_edge(d);
    return turns_left ? cells_.next(other) : cells_.previous(other);
  }

  /// The exit through a facet; none if the line leaves elsewhere.
  Exit_of through(Dart_of facet) const {
    bool is_through = true;
    boost::container::small_vector<Dart_of, 8> zeros;
    cells_.for_each_dart(facet, [&](Dart_of d) {
      for (const bool second : {false, true}) {
        if (!is_through || (second && D == 3)) continue;
        const int sign = signs_.along(a_, b_, d, second);
        is_through = sign >= 0;
        if (sign == 0) zeros.push_back(second ? cells_.next(d) : d);
      }
    });
    if (!is_through) return {};
    if (zeros.empty()) return {Exit_of::facet, facet};
    if constexpr (D == 2)
      return {Exit_of::vertex, zeros.front()};
    else
      return on_zero_ridges(facet, zeros);
  }

  /// The vertex or ridge, of those with sign 0, at which the line leaves a facet.
  template <class Zeros>
  Exit_of on_zero_ridges(Dart_of facet, const Zeros& zeros) const {
    for (const Dart_of d : zeros) {
      if (signs_.are_collinear(a_, b_, cells_.point(d))) return {Exit_of::vertex, d};
      if (signs_.are_collinear(a_, b_, cells_.end(d))) return {Exit_of::vertex, cells_.next(d)};
    }
    if (zeros.size() == 1) return {Exit_of::ridge, zeros.front()};
    // Several ridges on one line: the line leaves through that whose ends lie on different sides of it.
    for (const Dart_of d : zeros) {
      Dart_of off = cells_.next(cells_.next(d));
      while (off != d && signs_.are_collinear(cells_.point(d), cells_.end(d), cells_.point(off)))
        off = cells_.next(off);
      const auto across = [&](const Point& x) { return signs_.orientation(a_, b_, x, cells_.point(off)); };
      if (across(cells_.point(d)) * across(cells_.end(d)) < 0) return {Exit_of::ridge, d};
    }
    return {Exit_of::none, facet};
  }

  const Signs<Lcc>& signs_;
  const Cells<Lcc>& cells_;
  const Point &a_, &b_;
};

/// The ridges and vertices of a cell that a motion passes while it runs in the boundary of the cell: walls
/// may begin there. Theory: docs/walk.md, the rule, 5.
template <class Lcc>
class Boundary_places {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;
  using Exit_of = Exit<Lcc>;

  Boundary_places(const Signs<Lcc>& signs, const Point& a, const Point& b)
      : signs_(signs), cells_(signs.cells()), a_(a), b_(b) {}

  /// The next place after the one passed last, before the motion leaves the cell or ends in it; the start
  /// itself where nothing was passed yet. None if the motion does not run in the boundary.
  /// \param facets a dart of each facet of the cell
  /// \param sides those of the target
  /// \param passed when a ridge or vertex was passed last
  /// \param ends whether the motion ends in the cell
  Exit_of next(const typename Cells<Lcc>::Darts& facets,
               const boost::container::small_vector<std::int8_t, 16>& sides,
               const std::optional<Rational>& passed, bool ends) const {
    if (a_ == b_) return {};
    typename Cells<Lcc>::Darts planes;  // the facets in whose plane the motion lies
    for (std::size_t i = 0; i < facets.size(); ++i)
      if (sides[i] == 0 && signs_.side(facets[i], a_) == 0) planes.push_back(facets[i]);
    if (planes.empty()) return {};
    if (!passed)
      for (const Dart_of facet : planes)
        if (const Exit_of start = at_start(facet); start.kind != Exit_of::none) return start;
    if (planes.size() == 1) return {};  // the motion stays in that facet
    const Rational last = passed ? *passed : Rational(0);
    Exit_of first;
    std::optional<Rational> end;
    for_each_place(facets, planes, [&](Exit_of place) {
      if (!place.time) return;
      if (!end || *end < *place.time) end = place.time;
      if (last < *place.time && (!first.time || *place.time < *first.time)) first = place;
    });
    if (!first.time || *first.time >= 1 || (!ends && *first.time >= *end)) return {};
    return first;
  }

 private:
  Exit_of at_start(Dart_of facet) const {
    Exit_of start;
    cells_.for_each_dart(facet, [&](Dart_of d) {
      if (cells_.point(d) == a_) start = {Exit_of::vertex, d, Rational(0)};
      if (D == 2 && cells_.end(d) == a_) start = {Exit_of::vertex, cells_.next(d), Rational(0)};
    });
    if constexpr (D == 3)
      if (start.kind == Exit_of::none)
        cells_.for_each_dart(facet, [&](Dart_of d) {
          if (signs_.on_segment(cells_.point(d), cells_.end(d), a_)) start = {Exit_of::ridge, d, Rational(0)};
        });
    return start;
  }

  /// All vertices on the line, and ridges that it crosses, of the facets in whose plane it lies.
  template <class Visit>
  void for_each_place(const typename Cells<Lcc>::Darts& facets, const typename Cells<Lcc>::Darts& planes,
                      const Visit& visit) const {
    const auto visit_vertex = [&](Dart_of d) {
      visit({Exit_of::vertex, d, signs_.time_at(cells_.point(d), a_, b_)});
    };
    for (const Dart_of facet : planes)
      cells_.for_each_dart(facet, [&](Dart_of d) {
        if constexpr (D == 2) {
          visit_vertex(d);
          visit_vertex(cells_.next(d));
        } else {
          const Point &u = cells_.point(d), &v = cells_.end(d);
          if (signs_.are_collinear(a_, b_, u))
            visit_vertex(d);
          else if (!signs_.are_collinear(a_, b_, v) && crosses(facets, facet, u, v))
            visit({Exit_of::ridge, d, signs_.time_at(u, v, a_, b_)});
        }
      });
  }

  /// True if two points of a facet's plane lie on different sides of the motion in it.
  bool crosses(const typename Cells<Lcc>::Darts& facets, Dart_of facet, const Point& u,
               const Point& v) const {
    const Point* off = signs_.off_plane(facet, facets);
    return off && signs_.orientation(a_, b_, u, *off) * signs_.orientation(a_, b_, v, *off) < 0;
  }

  const Signs<Lcc>& signs_;
  const Cells<Lcc>& cells_;
  const Point &a_, &b_;
};

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_EXIT_H
