// SPDX-License-Identifier: LGPL-3.0-or-later
// The star of a ridge or vertex of a map: cells linked there, and those in which a motion continues, side by
// side. Theory: docs/walk.md, choices.
#ifndef CELLWALK_INTERNAL_LCC_STAR_H
#define CELLWALK_INTERNAL_LCC_STAR_H

#include <cellwalk/internal/lcc/signs.h>

#include <CGAL/number_utils.h>
#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace cellwalk::lcc::detail {

/// The cells that passable facets at a ridge or vertex link with one of them, breadth first.
template <class Lcc>
class Linked_cells {
 public:
  using Dart_of = Dart<Lcc>;

  Linked_cells(const Cells<Lcc>& cells, const Feature<Lcc>& start) : cells_(cells), found_{start} {
    names_.push_back(cells.name_at(start));
  }

  /// Calls visit(feature in the cell, facet, is_wall) for the facets of the k-th cell at the feature, and
  /// finds the cells behind passable ones.
  template <class Is_wall, class Visit>
  void expand(std::size_t k, const Is_wall& is_wall, const Visit& visit) {
    const Feature<Lcc> here = found_[k];
    cells_.for_each_facet_at(here, [&](Dart_of facet, Dart_of behind) {
      const bool blocks = is_wall(facet);
      visit(here, facet, blocks);
      if (blocks) return;
      const Feature<Lcc> there{behind, here.is_vertex};
      const Dart_of name = cells_.name_at(there);
      if (contains(names_, name)) return;
      names_.push_back(name);
      found_.push_back(there);
    });
  }
  /// Finds all.
  template <class Is_wall>
  void expand_all(const Is_wall& is_wall) {
    for (std::size_t k = 0; k < found_.size(); ++k) expand(k, is_wall, [](const auto&...) {});
  }

  std::size_t size() const { return found_.size(); }
  const Feature<Lcc>& operator[](std::size_t k) const { return found_[k]; }
  Dart_of name(std::size_t k) const { return names_[k]; }
  Dart_of least_name() const { return *std::min_element(names_.begin(), names_.end()); }

 private:
  const Cells<Lcc>& cells_;
  boost::container::small_vector<Feature<Lcc>, 16> found_;
  typename Cells<Lcc>::Darts names_;
};

/// The unit normal of a facet, rounded, on the side of its cell.
template <class Lcc>
auto inner_normal(const Signs<Lcc>& signs, Dart<Lcc> facet) {
  auto exact = signs.exact_normal(facet);
  Rational largest = 0;
  for (const Rational& x : exact) largest = std::max<Rational>(largest, CGAL::abs(x));
  std::array<double, static_cast<std::size_t>(Cells<Lcc>::D)> normal{};
  if (CGAL::is_zero(largest)) return normal;
  double squares = 0;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    normal[i] = CGAL::to_double(Rational(exact[i] / largest));
    squares += normal[i] * normal[i];
  }
  for (double& x : normal) x /= std::sqrt(squares);
  return normal;
}

/// The cells linked at a ridge or vertex in which the motion from a towards b continues: all their facets
/// there have b on their inner side or on them. Those that passable facets along the motion join form a side;
/// there are several if the motion runs along walls. Sides stand in the order of preference: first that on
/// which the displaced target lies, then counterclockwise about the motion (3D).
template <class Lcc, class Is_wall>
class Star {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;

  Star(const Signs<Lcc>& signs, const Is_wall& is_wall, const Feature<Lcc>& start, const Point& a,
       const Point& b)
      : signs_(signs), is_wall_(is_wall), a_(a), b_(b), linked_(signs.cells(), start) {
    ++signs.counts().stars;
    for (std::size_t k = 0; k < linked_.size(); ++k)
      if (visit(k)) return;
    if (candidates_.size() > 1) sort();
  }

  std::size_t side_count() const { return candidates_.empty() ? 0 : candidates_.back().rank + 1; }
  /// The feature's dart in the cell in which the motion goes on along the k-th side: that of the start if it
  /// lies there.
  /// \pre k < side_count()
  Feature<Lcc> on_side(std::size_t k) const {
    const Candidate* taken = nullptr;
    for (const Candidate& c : candidates_)
      if (c.rank == k && (!taken || c.place == 0)) taken = &c;
    return linked_[taken->place];
  }
  bool is_start(const Feature<Lcc>& feature) const { return feature.dart == linked_[0].dart; }
  /// The same for all cells linked there, and for no others.
  Dart_of name() const { return linked_.least_name(); }

  struct Wall {
    Feature<Lcc> feature;  ///< in its cell
    Dart_of facet;
  };
  /// The wall that blocks the motion, if there is no side: of several the one met most head-on, and of those
  /// the first by its corners. None by rounded signs only.
  std::optional<Wall> wall() const {
    std::optional<Wall> best;
    for (const Wall& wall : walls_)
      if (!best || is_met_before(wall.facet, best->facet)) best = wall;
    return best;
  }

 private:
  struct Candidate {
    std::size_t place;  ///< among the linked cells
    bool is_displaced;  ///< it contains the displaced target
    std::size_t rank;   ///< of its side
  };

  /// True if the motion continues in the interior of the cell, so that there is no other candidate.
  bool visit(std::size_t k) {
    bool is_candidate = true, is_inside = true, is_displaced = true;
    linked_.expand(k, is_wall_, [&](const Feature<Lcc>& here, Dart_of facet, bool is_wall) {
      const int side = signs_.side(facet, b_);
      is_candidate &= side <= 0;
      is_inside &= side < 0;
      is_displaced &= side < 0 || (side == 0 && signs_.displaced_side(facet) < 0);
      if (is_wall && side > 0) walls_.push_back({here, facet});
    });
    if (is_candidate) candidates_.push_back({k, is_displaced, candidates_.size()});
    return is_candidate && is_inside;
  }

  /// True if the motion meets a facet more head-on than another one, or as much and it stands before it by
  /// its corners.
  bool is_met_before(Dart_of facet, Dart_of other) const {
    const auto [slope, square] = steepness(facet);
    const auto [other_slope, other_square] = steepness(other);
    const Rational here = slope * slope * other_square, there = other_slope * other_slope * square;
    return here != there ? here > there : corners(facet) < corners(other);
  }
  /// The product of a facet's normal, of some length, with the motion, and the square of that length.
  std::pair<Rational, Rational> steepness(Dart_of facet) const {
    const auto normal = signs_.exact_normal(facet);
    const auto a = Signs<Lcc>::exact(a_), b = Signs<Lcc>::exact(b_);
    Rational slope = 0, square = 0;
    for (std::size_t i = 0; i < normal.size(); ++i) {
      slope += normal[i] * (b[i] - a[i]);
      square += normal[i] * normal[i];
    }
    return {slope, square};
  }
  auto corners(Dart_of facet) const {
    boost::container::small_vector<Point, 4> points;
    const Cells<Lcc>& cells = signs_.cells();
    cells.for_each_dart(facet, [&](Dart_of d) { points.push_back(cells.point(d)); });
    if constexpr (D == 2) points.push_back(cells.end(facet));
    std::sort(points.begin(), points.end());
    return points;
  }

  void sort() {
    join_sides();
    std::stable_sort(candidates_.begin(), candidates_.end(), [&](const Candidate& x, const Candidate& y) {
      if (x.is_displaced != y.is_displaced) return x.is_displaced;
      if constexpr (D == 2)
        return false;
      else
        return turns_before(linked_[x.place].dart, linked_[y.place].dart);
    });
    // Numbers sides in the order in which they appear.
    boost::container::small_vector<std::size_t, 4> sides;
    for (Candidate& c : candidates_) {
      auto known = std::find(sides.begin(), sides.end(), c.rank);
      if (known == sides.end()) known = sides.insert(sides.end(), c.rank);
      c.rank = static_cast<std::size_t>(known - sides.begin());
    }
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& x, const Candidate& y) { return x.rank < y.rank; });
  }

  /// Candidates joined by a passable facet along the motion get the same rank.
  void join_sides() {
    for (std::size_t x = 0; x < candidates_.size(); ++x) {
      const Feature<Lcc> here = linked_[candidates_[x].place];
      signs_.cells().for_each_facet_at(here, [&](Dart_of facet, Dart_of behind) {
        if (is_wall_(facet)) return;
        const Dart_of name = signs_.cells().name_at({behind, here.is_vertex});
        for (std::size_t y = 0; y < candidates_.size(); ++y) {
          if (linked_.name(candidates_[y].place) != name || !holds_more(here, facet)) continue;
          const std::size_t from = candidates_[y].rank, to = candidates_[x].rank;
          for (Candidate& c : candidates_)
            if (c.rank == from) c.rank = to;
        }
      });
    }
  }

  /// True if a facet at the feature contains a further piece of the motion.
  bool holds_more(const Feature<Lcc>& here, Dart_of facet) const {
    if (signs_.side(facet, b_) != 0) return false;
    const Cells<Lcc>& cells = signs_.cells();
    if constexpr (D == 2) {
      const Point& start = cells.point(here.dart);
      const Point& other = facet == here.dart ? cells.end(facet) : cells.point(facet);
      return CGAL::compare_xy(a_, b_) == CGAL::compare_xy(start, other);  // on one line
    } else {
      // In the plane of the facet b lies on the inner side of its ridges there, or on them.
      const Point* off = signs_.off_plane(facet, cells.facets(facet));
      if (!off) return false;  // by rounded signs only
      const auto is_beyond = [&](Dart_of d) {
        return signs_.map_orientation() * signs_.orientation(cells.point(d), cells.end(d), *off, b_) < 0;
      };
      if (is_beyond(facet)) return false;
      return !here.is_vertex || !is_beyond(cells.previous(facet));
    }
  }

  /// True if one comes to the cell of x before that of y, turning counterclockwise about the motion, seen
  /// against it, from the direction of the displacement.
  bool turns_before(Dart_of x, Dart_of y) const {
    const Point *u = first_corner(x), *v = first_corner(y);
    if (!u || !v) return false;
    const int u_side = signs_.displaced_side(a_, b_, *u), v_side = signs_.displaced_side(a_, b_, *v);
    return u_side != v_side ? u_side < v_side : signs_.orientation(a_, b_, *u, *v) > 0;
  }

  /// A corner off the line that comes before all others.
  const Point* first_corner(Dart_of cell) const {
    const auto facets = signs_.cells().facets(cell);
    const Point* first = nullptr;
    // Half a turn after the first corner signs are 0: a second round finds it if others came between.
    for (int round = 0; round < 2; ++round)
      signs_.cells().for_each_point(facets, [&](const Point& x) {
        if (signs_.are_collinear(a_, b_, x)) return true;
        if (!first || signs_.orientation(a_, b_, *first, x) < 0) first = &x;
        return true;
      });
    return first;
  }

  const Signs<Lcc>& signs_;
  const Is_wall& is_wall_;
  const Point &a_, &b_;
  Linked_cells<Lcc> linked_;
  boost::container::small_vector<Candidate, 4> candidates_;
  boost::container::small_vector<Wall, 4> walls_;  ///< beyond which the target lies
};

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_STAR_H
