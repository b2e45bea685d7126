// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's walk and check of edges on any linear cell complex of CGAL, by its darts alone: header-only,
// and independent of environments and snapshots. Paper: sections II and III. Manual: docs/lcc.md.
#ifndef CELLWALK_LCC_WALKER_H
#define CELLWALK_LCC_WALKER_H

#include <cellwalk/internal/lcc/place.h>
#include <cellwalk/internal/lcc/run.h>
#include <cellwalk/internal/lcc/types.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace cellwalk::lcc {

/// The facets on the boundary of a map are its only walls.
struct No_inner_walls {
  template <class Dart_of>
  bool operator()(const Dart_of&) const {
    return false;
  }
};

/// Walls are the facets whose darts have a mark of the map, and those on its boundary.
template <class Lcc>
class Marked_walls {
 public:
  Marked_walls(const Lcc& map, typename Lcc::size_type mark) : map_(&map), mark_(mark) {}
  bool operator()(const Dart<Lcc>& d) const { return map_->is_marked(d, mark_); }

 private:
  const Lcc* map_;
  typename Lcc::size_type mark_;
};

/// Particles and edges in the cells of a map.
///
/// \tparam Lcc a `CGAL::Linear_cell_complex_for_combinatorial_map<D, D, ...>`, D = 2 or 3, whose points are
///         those of a CGAL kernel. Answers are exact if the predicates of the kernel are (`Epick`, `Epeck`).
///         With rounded ones, as of `Simple_cartesian<double>`, walks may miss walls or be lost, but end.
/// \tparam Is_wall `bool operator()(Dart<Lcc>) const`: whether the facet of a dart is impassable, the same
///         for all its darts on both sides. Facets on the boundary (free for beta_D) are walls anyway.
/// \pre Cells are closed, convex and of positive volume, with planar convex facets, glued along whole facets;
///      in space collinear vertices and coplanar facets are allowed. find_defect() checks it. Faces of all
///      cells are oriented alike, as they are in maps whose cells were sewn by CGAL.
///
/// The map may be changed between calls by any operation of CGAL that leaves it as required: nothing is
/// stored but a reference to it, and its orientation. So make a new walker where that may be another one:
/// after reverse_orientation(), or for cells made in an empty map. Particles whose dart was removed must be
/// located again.
/// Calls only read the map, by beta and points, so that several threads may walk at once; particles_at() and
/// find_defect() take marks.
template <class Lcc, class Is_wall = No_inner_walls>
class Walker {
 public:
  static constexpr int D = static_cast<int>(Lcc::dimension);
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;

  /// Cost: that of one cell.
  explicit Walker(const Lcc& map, Is_wall is_wall = {})
      : cells_(map), is_wall_(std::move(is_wall)), orientation_(find_orientation()) {}

  /// The walk of a particle to a target. Paper: section II.
  ///
  /// The particle turns from the facet that it aims at to the next ones until the target lies in the cone of
  /// a facet over its position. Where a sign is 0, the rule of exits decides: at a ridge or vertex the walk
  /// continues in a cell that passable facets link there. Touching a wall is no contact, crossing it is. Of
  /// several sides of walls it takes those on which it gets furthest, the first of them in an order that
  /// depends on the geometry only.
  /// \pre the position lies in the closed cell of the particle's dart
  /// Degenerate cases: motions through vertices and edges, in walls and along edges are decided; one of
  /// length zero arrives. Cost: constant for each cell crossed, for bounded cells; that of the star at a
  /// ridge or vertex.
  Walk<Lcc> walk(const Particle<Lcc>& particle, const Point& target, Counts& counts) const {
    const Signs signs(cells_, orientation_, counts);
    return furthest(signs, particle, target, nullptr, [](const Walk<Lcc>&) { return true; });
  }

  /// Moves the particle if the walk arrives; otherwise it stays.
  Walk<Lcc> move(Particle<Lcc>& particle, const Point& target, Counts& counts) const {
    const Walk<Lcc> result = walk(particle, target, counts);
    if (result.status == Status::arrived) particle = {target, result.dart};
    return result;
  }

  /// Moves the end p of an edge to a target while q stands still: p walks to the target, then a temporary
  /// particle from there to q, where it has to be linked with the cell of q. Paper: section III. Obstacles
  /// that fit between the three segments are not seen: that is the paper's stated limit.
  ///
  /// The motion is free if it is on some choice of sides of walls, of p and of the temporary particle.
  /// \pre p and q lie in the closed cells of their darts, and the edge between them crosses no wall
  /// Cost: two walks.
  Edge_check<Lcc> check_edge(const Particle<Lcc>& p, const Point& target, const Particle<Lcc>& q,
                             Counts& counts) const {
    return check_edge(p, target, q, counts, nullptr);
  }
  /// The same.
  /// \param traversed if not null, receives a dart of each cell that the temporary particle visited, where
  ///        the edge is blocked
  Edge_check<Lcc> check_edge(const Particle<Lcc>& p, const Point& target, const Particle<Lcc>& q,
                             Counts& counts, std::vector<Dart_of>* traversed) const;

  /// True if passable facets that contain a point link two cells.
  /// \pre the point lies in the closed cells of both darts
  bool are_linked(const Dart_of& cell, const Dart_of& other, const Point& x, Counts& counts) const {
    const Signs signs(cells_, orientation_, counts);
    return are_linked(signs, cell, other, x);
  }

  /// A particle for each class of linked cells that contain a point; none outside the map. On a wall there is
  /// one for each of its sides.
  /// Cost: linear in the number of cells. Takes a mark of the map.
  std::vector<Particle<Lcc>> particles_at(const Point& x) const;

  const Lcc& map() const { return cells_.map(); }
  /// 1 if facets are seen counterclockwise from outside their cells (in the plane: cells), -1 if clockwise.
  int orientation() const { return orientation_; }
  /// Facets that nothing passes: walls, and those on the boundary.
  bool is_impassable(const Dart_of& facet) const { return blocks()(facet); }

 private:
  using Signs = detail::Signs<Lcc>;
  using Blocks = detail::Blocks<Lcc, Is_wall>;
  using Run = detail::Run<Lcc, Blocks>;

  Blocks blocks() const { return {cells_, is_wall_}; }

  int find_orientation() const {
    if (cells_.map().darts().empty()) return 1;
    Counts counts;
    const Dart_of first = cells_.map().darts().begin();
    if (!cells_.is_closed(first)) return 1;
    const Signs signs(cells_, 1, counts);
    const Point* off = signs.off_plane(first, cells_.facets(first));
    return off && signs.side(first, *off) > 0 ? -1 : 1;
  }

  /// The walk on the sides of walls on which it gets furthest, of those whose end is accepted.
  template <class Accept>
  Walk<Lcc> furthest(const Signs& signs, const Particle<Lcc>& particle, const Point& target,
                     std::vector<Dart_of>* visited, const Accept& accept) const;
  bool are_linked(const Signs& signs, const Dart_of& cell, const Dart_of& other, const Point& x) const;
  Walk<Lcc> walk_along_edge(const Signs& signs, const Particle<Lcc>& p, const Particle<Lcc>& q,
                            std::vector<Dart_of>* visited) const;

  const detail::Cells<Lcc> cells_;
  const Is_wall is_wall_;
  const int orientation_;
};

template <class Lcc, class Is_wall>
template <class Accept>
Walk<Lcc> Walker<Lcc, Is_wall>::furthest(const Signs& signs, const Particle<Lcc>& particle,
                                         const Point& target, std::vector<Dart_of>* visited,
                                         const Accept& accept) const {
  const Blocks blocks = this->blocks();
  detail::Choices<Dart_of> choices;
  std::optional<Walk<Lcc>> best;
  std::vector<Dart_of> seen;
  do {
    seen.clear();
    Walk<Lcc> walk = Run(signs, blocks, particle, target).run(choices, visited ? &seen : nullptr);
    const bool is_free = walk.status == Status::arrived && accept(walk);
    const bool is_better = is_free || !best ||
                           (best->status == Status::contact && walk.status == Status::arrived) ||
                           (best->contact && walk.contact && best->contact->time < walk.contact->time);
    if (is_better) {
      best = std::move(walk);
      if (visited) *visited = seen;
    }
    if (is_free) break;
  } while (choices.take_next());
  return *best;
}

template <class Lcc, class Is_wall>
bool Walker<Lcc, Is_wall>::are_linked(const Signs& signs, const Dart_of& cell, const Dart_of& other,
                                      const Point& x) const {
  const detail::Places<Lcc> places(signs);
  const auto here = places.find(cell, x);
  if (!here) return false;
  const Dart_of facet = cells_.facet_of(other);
  bool found = false;
  places.for_each_linked(*here, blocks(), [&](const Dart_of& linked) {
    if (found) return;
    for (const Dart_of& own : cells_.facets(linked)) found = found || cells_.facet_of(own) == facet;
  });
  return found;
}

template <class Lcc, class Is_wall>
Walk<Lcc> Walker<Lcc, Is_wall>::walk_along_edge(const Signs& signs, const Particle<Lcc>& p,
                                                const Particle<Lcc>& q, std::vector<Dart_of>* visited) const {
  bool is_linked = false;
  Walk<Lcc> walk = furthest(signs, p, q.position, visited, [&](const Walk<Lcc>& arrived) {
    return is_linked = are_linked(signs, arrived.dart, q.dart, q.position);
  });
  if (walk.status != Status::arrived || is_linked) return walk;
  // It arrives on another side of a wall at q.
  walk.status = Status::contact;
  const detail::Places<Lcc> places(signs);
  if (const auto place = places.find(walk.dart, q.position))
    places.for_each_linked(*place, blocks(), [&](const Dart_of& linked) {
      const auto test = [&](const Dart_of& facet) {
        if (!walk.contact && is_impassable(facet))
          walk.contact =
              Contact<Lcc>{Rational(1), place->dimension, facet, linked, inner_normal(signs, facet)};
      };
      if (place->dimension < D - 1)
        cells_.for_each_facet_at({linked, place->dimension == 0},
                                 [&](const Dart_of& facet, const Dart_of&) { test(facet); });
      else
        test(linked);
    });
  if (!walk.contact) walk.status = Status::lost;  // by rounded signs only
  return walk;
}

template <class Lcc, class Is_wall>
Edge_check<Lcc> Walker<Lcc, Is_wall>::check_edge(const Particle<Lcc>& p, const Point& target,
                                                 const Particle<Lcc>& q, Counts& counts,
                                                 std::vector<Dart_of>* traversed) const {
  const Signs signs(cells_, orientation_, counts);
  const Blocks blocks = this->blocks();
  detail::Choices<Dart_of> choices;
  std::optional<Edge_check<Lcc>> best;
  std::vector<Dart_of> seen;
  do {
    const Walk<Lcc> way = Run(signs, blocks, p, target).run(choices);
    Edge_check<Lcc> check{way.status, p, way.contact, way.status == Status::contact};
    seen.clear();
    if (way.status == Status::arrived) {
      check.p = {target, way.dart};
      const Walk<Lcc> edge = walk_along_edge(signs, check.p, q, traversed ? &seen : nullptr);
      check.status = edge.status;
      check.contact = edge.contact;
    }
    const bool is_free = check.status == Status::arrived;
    // An edge that is blocked at the target is further than p that is blocked on its way.
    const bool is_better = is_free || !best ||
                           (best->is_by_vertex && check.contact &&
                            (!check.is_by_vertex || best->contact->time < check.contact->time));
    if (is_better) {
      best = std::move(check);
      if (traversed) *traversed = seen;
    }
    if (is_free) break;
  } while (choices.take_next());
  if (best->status != Status::arrived) best->p = p;
  return *best;
}

template <class Lcc, class Is_wall>
std::vector<Particle<Lcc>> Walker<Lcc, Is_wall>::particles_at(const Point& x) const {
  Counts counts;
  const Signs signs(cells_, orientation_, counts);
  const detail::Places<Lcc> places(signs);
  std::vector<Particle<Lcc>> particles;
  std::vector<Dart_of> known;  // facets of cells that were found
  const auto cells = cells_.map().template one_dart_per_cell<D>();
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    const Dart_of cell = it;
    const auto place = places.find(cell, x);
    if (!place || detail::contains(known, cells_.facet_of(place->dart))) continue;
    particles.push_back({x, place->dart});
    places.for_each_linked(*place, blocks(), [&](const Dart_of& linked) {
      for (const Dart_of& facet : cells_.facets(linked)) known.push_back(cells_.facet_of(facet));
    });
  }
  return particles;
}

}  // namespace cellwalk::lcc

#endif  // CELLWALK_LCC_WALKER_H
