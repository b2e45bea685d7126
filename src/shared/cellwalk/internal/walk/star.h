// SPDX-License-Identifier: LGPL-3.0-or-later
// The search of the star of a ridge or vertex that a line passes exactly. Rule: docs/walk.md, step 4.
#ifndef CELLWALK_INTERNAL_WALK_STAR_H
#define CELLWALK_INTERNAL_WALK_STAR_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// Corners that span a facet.
template <int D>
using Spanning_corners = std::array<const Point<D>*, static_cast<std::size_t>(D)>;

/// Corners that span facet i, in its order, independent of the order in which cells and points are listed.
inline Spanning_corners<2> spanning_corners(const Cell_view<2>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  return {&cell.point(loop[0]), &cell.point(loop[1])};
}

inline Spanning_corners<3> spanning_corners(const Cell_view<3>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const std::size_t n = loop.size();
  std::size_t first = 0;
  const Point<3>* least = &cell.point(loop[0]);
  for (std::size_t k = 1; k < n; ++k) {
    const Point<3>& p = cell.point(loop[k]);
    const Point<3>& q = *least;
    if (p[0] > q[0]) continue;
    if (p[0] == q[0] && (p[1] > q[1] || (p[1] == q[1] && p[2] > q[2]))) continue;
    first = k;
    least = &p;
  }
  // The line through its neighbours does not contain the least corner: the facet has an angle there.
  return {least, &cell.point(loop[first + 1 < n ? first + 1 : 0]),
          &cell.point(loop[first > 0 ? first - 1 : n - 1])};
}

/// The same as inner_normal(), by the spanning corners of the facet.
inline Vector<2> inner_normal(const Spanning_corners<2>& corners) {
  return unit_normal(*corners[0], *corners[1]);
}

inline Vector<3> inner_normal(const Spanning_corners<3>& corners) {
  return unit_normal(*corners[0], *corners[2], *corners[1]);
}

/// Unit normal of a half-facet towards its cell, rounded.
template <int D>
Vector<D> inner_normal(const Cell_view<D>& cell, std::size_t i) {
  return inner_normal(spanning_corners(cell, i));
}

/// An order of facets by the positions of their corners, independent of their numbering. Coincident facets
/// are equal.
template <int D>
bool is_placed_before(const Cell_view<D>& cell, std::size_t i, const Cell_view<D>& other, std::size_t j) {
  const auto sorted_corners = [](const Cell_view<D>& of, std::size_t facet) {
    boost::container::small_vector<Point<D>, 4> corners;
    for (const std::uint16_t v : of.loop(facet)) corners.push_back(of.point(v));
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  return sorted_corners(cell, i) < sorted_corners(other, j);
}

/// Of two half-facets the first in that order. `first` may be none.
template <int D>
Half_facet first_placed(const Snapshot<D>& snapshot, Half_facet first, Half_facet other) {
  if (first == Half_facet::none) return other;
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(first));
  const bool is_before = is_placed_before(snapshot.view(snapshot.cell_of(other)), snapshot.facet_of(other),
                                          cell, snapshot.facet_of(first));
  return is_before ? other : first;
}

/// True if facet i of a cell contains point u, and v too (3D ridge).
template <int D>
bool facet_contains(const Cell_view<D>& cell, std::size_t i, std::uint32_t u, std::uint32_t v) {
  bool has_u = false, has_v = false;
  for (const std::uint16_t w : cell.loop(i)) {
    has_u |= cell.point_index(w) == u;
    has_v |= cell.point_index(w) == v;
  }
  return has_u && has_v;
}

/// The side of facet i on which a displaced point of its plane lies, see displaced_side(): > 0 outside the
/// cell.
inline int displaced_side(const Cell_view<2>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  return -cellwalk::displaced_side(cell.point(loop[0]), cell.point(loop[1]));
}

inline int displaced_side(const Cell_view<3>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  return cellwalk::displaced_side(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]));
}

/// The counterclockwise order of cells with the line ab in their boundary, about that line and seen against
/// its direction, starting at the direction of the displacement of displaced_side().
/// \pre no two of the cells overlap, and the displaced point is in none of them
template <class Kernel>
class Rotational_order {
 public:
  Rotational_order(const Point<3>& a, const Point<3>& b, Walk_counts& counts)
      : a_(a), b_(b), counts_(counts) {}

  bool operator()(const Cell_view<3>& x, const Cell_view<3>& y) const {
    const Point<3>&u = first_corner(x), &v = first_corner(y);
    const int u_side = cellwalk::displaced_side(a_, b_, u), v_side = cellwalk::displaced_side(a_, b_, v);
    // Where the plane of the line and a corner has the displaced point on its right, the corner comes within
    // half a turn.
    return u_side != v_side ? u_side < v_side : turn(u, v) > 0;
  }

 private:
  /// > 0 if one turns from u to v counterclockwise.
  int turn(const Point<3>& u, const Point<3>& v) const {
    ++counts_.along_tests;
    return Kernel::orientation(counts_.predicates, a_, b_, u, v);
  }

  /// A corner off the line that comes before all others, if the turn starts outside of the cell; any if there
  /// is no line: by rounded signs a motion may leave a cell although it ends where it starts.
  const Point<3>& first_corner(const Cell_view<3>& cell) const {
    std::size_t first = cell.vertex_count();
    for (std::size_t k = 0; k < cell.vertex_count(); ++k) {
      if (are_collinear(a_, b_, cell.point(k))) continue;
      if (first == cell.vertex_count() || turn(cell.point(first), cell.point(k)) < 0) first = k;
    }
    // Half a turn after the first corner signs are 0. Corners in between have determined the first one,
    // unless they came later.
    for (std::size_t k = 0; k < cell.vertex_count(); ++k)
      if (first != k && !are_collinear(a_, b_, cell.point(k)) && turn(cell.point(first), cell.point(k)) < 0)
        first = k;
    return cell.point(first == cell.vertex_count() ? 0 : first);
  }

  const Point<3>&a_, &b_;
  Walk_counts& counts_;
};

/// The facets on a path through a star.
using Star_path = boost::container::small_vector<Half_facet, 8>;

/// The search of the star of ridge uv (or vertex u = v), through passable facets from `start`, for cells in
/// which the motion from a towards b continues: all their facets at the ridge or vertex have b on their inner
/// side or on them.
///
/// These cells are the candidates. Candidates joined by passable facets along the motion form a side; there
/// are several sides if the motion runs along walls. Their order depends on the geometry only: first the side
/// on which the displaced point b lies, see displaced_side(), then counterclockwise about the line ab (3D).
/// Within the first side `start` comes first.
template <class Kernel, int D>
class Star_search {
 public:
  Star_search(const Snapshot<D>& snapshot, Cell start, std::uint32_t u, std::uint32_t v, const Point<D>& a,
              const Point<D>& b, Walk_counts& counts)
      : snapshot_(snapshot), u_(u), v_(v), a_(a), b_(b), counts_(counts), links_(snapshot, start) {
    ++counts.star_searches;
    while (links_.next())
      if (visit()) return;
    if (candidates_.size() > 1) sort();
  }

  struct Candidate {
    std::size_t place;  ///< among the cells found
    bool is_displaced;  ///< it contains the displaced point b
    int side;           ///< candidates of one side have the same number
  };
  using Candidates = boost::container::small_vector<Candidate, 4>;

  const Candidates& candidates() const { return candidates_; }
  Cell cell(const Candidate& candidate) const { return links_.cell(candidate.place); }
  /// True if the motion can continue on more than one side.
  bool has_choice() const {
    return std::any_of(candidates_.begin(), candidates_.end(),
                       [&](const Candidate& c) { return c.side != candidates_.front().side; });
  }
  std::size_t side_count() const {
    std::size_t count = 0;
    for (auto c = candidates_.begin(); c != candidates_.end(); ++c) count += is_first_of_side(c);
    return count;
  }
  /// The candidate on the k-th side in which the motion goes on: `start` if it lies there.
  const Candidate& on_side(std::size_t k) const {
    auto first = candidates_.begin();
    for (;; ++first)
      if (is_first_of_side(first) && k-- == 0) break;
    const auto start = std::find_if(
        first, candidates_.end(), [&](const Candidate& c) { return c.place == 0 && c.side == first->side; });
    return start == candidates_.end() ? *first : *start;
  }
  /// The least of the cells linked at the ridge or vertex.
  /// \pre has_choice()
  Cell least_cell() const {
    Cell least = links_.cell(0);
    for (std::size_t place = 1; place <= links_.place(); ++place) least = std::min(least, links_.cell(place));
    return least;
  }
  /// The facets on the path to a candidate.
  Star_path path(const Candidate& candidate) const {
    Star_path path;
    links_.append_path(candidate.place, path);
    return path;
  }
  /// A wall that blocks the motion, if there is one: of several the one met most head-on. No decision depends
  /// on the choice.
  Half_facet wall() const { return wall_; }

 private:
  bool is_first_of_side(typename Candidates::const_iterator c) const {
    return std::none_of(candidates_.begin(), c,
                        [&](const Candidate& other) { return other.side == c->side; });
  }

  /// True if the motion continues in the interior of the cell, so that there is no other candidate.
  bool visit() {
    ++counts_.star_cells;
    bool is_candidate = true, is_inside = true, is_displaced = true;
    int side = 0;
    const auto is_at_feature = [&](const Cell_view<D>& cell, std::size_t i) {
      if (!facet_contains(cell, i, u_, v_)) return false;
      side = detail::side<Kernel>(cell, i, b_, counts_);
      is_candidate &= side <= 0;
      is_inside &= side < 0;
      is_displaced &= side < 0 || (side == 0 && displaced_side(cell, i) < 0);
      return true;
    };
    links_.expand_all(is_at_feature, [&](const Cell_view<D>& cell, std::size_t i, Half_facet wall) {
      if (side > 0) note_wall(wall, cell, i);
    });
    if (is_candidate)
      candidates_.push_back({links_.place(), is_displaced, static_cast<int>(candidates_.size())});
    return is_candidate && is_inside;
  }

  void note_wall(Half_facet f, const Cell_view<D>& cell, std::size_t i) {
    const double slope = dot(inner_normal(cell, i), a_ - b_);
    if (wall_ != Half_facet::none) {
      if (slope < steepest_) return;
      const Cell_view<D> other = snapshot_.view(snapshot_.cell_of(wall_));
      if (slope == steepest_ && !is_placed_before(cell, i, other, snapshot_.facet_of(wall_))) return;
    }
    wall_ = f;
    steepest_ = slope;
  }

  void sort() {
    join_sides();
    std::stable_sort(candidates_.begin(), candidates_.end(), [&](const Candidate& x, const Candidate& y) {
      if (x.is_displaced != y.is_displaced) return x.is_displaced;
      if constexpr (D == 2)
        return false;
      else
        return Rotational_order<Kernel>{a_, b_, counts_}(snapshot_.view(cell(x)), snapshot_.view(cell(y)));
    });
    const int first = candidates_.front().side;
    std::stable_sort(candidates_.begin(), candidates_.end(), [&](const Candidate& x, const Candidate& y) {
      const auto rank = [&](const Candidate& c) { return c.side != first ? 2 : c.place != 0 ? 1 : 0; };
      return rank(x) < rank(y);
    });
  }

  /// Numbers the sides: candidates joined by a passable facet along the motion get the same number.
  void join_sides() {
    for (const Candidate& x : candidates_) {
      const Cell_view<D> view = snapshot_.view(cell(x));
      for (std::size_t i = 0; i < view.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(cell(x), i);
        if (snapshot_.is_impassable(f) || !facet_contains(view, i, u_, v_)) continue;
        const Cell next = snapshot_.neighbour(f);
        const auto other = std::find_if(candidates_.begin(), candidates_.end(),
                                        [&](const Candidate& y) { return cell(y) == next; });
        if (other == candidates_.end() || !holds_more(view, i)) continue;
        const int from = other->side, to = x.side;
        for (Candidate& y : candidates_)
          if (y.side == from) y.side = to;
      }
    }
  }

  /// True if facet i of a cell, which contains the ridge or vertex, contains a further piece of the motion.
  bool holds_more(const Cell_view<D>& cell, std::size_t i) const {
    if (detail::side<Kernel>(cell, i, b_, counts_) != 0) return false;
    const auto loop = cell.loop(i);
    const auto at = [&](std::size_t k) { return loop[k % loop.size()]; };
    if constexpr (D == 2) {
      const Point<2>& other = cell.point(cell.point_index(loop[0]) == u_ ? loop[1] : loop[0]);
      const Point<2>& here = snapshot_.point(u_);
      return (a_ < b_) == (here < other);  // on one line
    } else {
      std::size_t off = 0;
      while (off < cell.vertex_count() && detail::side<Kernel>(cell, i, cell.point(off), counts_) == 0) ++off;
      if (off == cell.vertex_count()) return false;  // inexact policies only
      // In the plane of the facet b lies on the inner side of its ridges there, or on them.
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t p = cell.point_index(at(k)), q = cell.point_index(at(k + 1));
        const bool is_there = u_ == v_ ? p == u_ || q == u_ : (p == u_ && q == v_) || (p == v_ && q == u_);
        if (!is_there) continue;
        ++counts_.along_tests;
        if (Kernel::orientation(counts_.predicates, cell.point(at(k)), cell.point(at(k + 1)), cell.point(off),
                                b_) < 0)
          return false;
      }
      return true;
    }
  }

  const Snapshot<D>& snapshot_;
  const std::uint32_t u_, v_;
  const Point<D>&a_, &b_;
  Walk_counts& counts_;
  Link_search<D> links_;
  Candidates candidates_;
  Half_facet wall_ = Half_facet::none;
  double steepest_ = 0;
};

/// Takes the corners of a cell, in increasing order, if they are less than the least so far, or the first.
/// Sides in the order of their least corners do not depend on lists of cells, nor on which cell stands for a
/// side.
template <int D>
void take_least(const Cell_view<D>& cell, std::vector<Point<D>>& least) {
  std::vector<Point<D>> corners;
  for (std::size_t v = 0; v < cell.vertex_count(); ++v) corners.push_back(cell.point(v));
  std::ranges::sort(corners);
  if (least.empty() || corners < least) least = std::move(corners);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_STAR_H
