// SPDX-License-Identifier: LGPL-3.0-or-later
// The check of a linear cell complex of a user's own, before anything walks in it. Manual: docs/lcc.md.
#ifndef CELLWALK_LCC_DEFECT_H
#define CELLWALK_LCC_DEFECT_H

#include <cellwalk/lcc/walker.h>

#include <cstdint>
#include <optional>

namespace cellwalk::lcc {

enum class Defect_kind : std::uint8_t {
  open_cell,        ///< a dart without a neighbour in its cell, or without a point
  short_edge,       ///< the ends of an edge coincide (in space)
  flat_facet,       ///< all vertices of the facet are collinear (in the plane: coincide)
  bent_facet,       ///< its vertices do not lie in one plane
  nonconvex_facet,  ///< its polygon has a reflex angle
  nonconvex_cell,   ///< a vertex of the cell lies outside the facet, or cells are oriented differently
  flat_cell,        ///< all vertices of the cell lie in the plane of the facet
  parted_facet,     ///< the two sides of the facet have different vertices
  one_sided_wall    ///< Is_wall differs between darts of the facet
};

template <class Lcc>
struct Defect {
  Defect_kind kind;
  Dart<Lcc> dart;  ///< of the facet
};

namespace detail {

template <class Lcc, class Is_wall>
class Defect_finder {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Dart_of = Dart<Lcc>;
  using Found = std::optional<Defect_kind>;

  Defect_finder(const Walker<Lcc, Is_wall>& walker, const Cells<Lcc>& cells, const Signs<Lcc>& signs)
      : walker_(walker), cells_(cells), signs_(signs) {}

  /// \pre no dart of the cell is open
  Found find(Dart_of facet, const typename Cells<Lcc>::Darts& facets) const {
    Found found;
    if constexpr (D == 3) {
      cells_.for_each_dart(facet, [&](Dart_of d) {
        if (cells_.point(d) == cells_.end(d)) found = Defect_kind::short_edge;
      });
      if (found) return found;
    }
    if (is_flat(facet)) return Defect_kind::flat_facet;
    bool is_flat_cell = true;
    cells_.for_each_point(facets, [&](const auto& x) {
      const int side = signs_.side(facet, x);
      if (side > 0) found = Defect_kind::nonconvex_cell;
      is_flat_cell &= side == 0;
      return !found;
    });
    cells_.for_each_dart(facet, [&](Dart_of d) {
      if (D == 3 && signs_.side(facet, cells_.point(d)) != 0) found = Defect_kind::bent_facet;
    });
    if (found) return found;
    if (is_flat_cell) return Defect_kind::flat_cell;
    if constexpr (D == 3)
      if (!is_convex(facet, facets)) return Defect_kind::nonconvex_facet;
    return across(facet);
  }

 private:
  bool is_flat(Dart_of facet) const {
    const auto corners = signs_.spanning(facet);
    if constexpr (D == 2)
      return *corners[0] == *corners[1];
    else
      return signs_.are_collinear(*corners[0], *corners[1], *corners[2]);
  }

  bool is_convex(Dart_of facet, const typename Cells<Lcc>::Darts& facets) const {
    const auto* off = signs_.off_plane(facet, facets);
    bool is_convex = true;
    cells_.for_each_dart(facet, [&](Dart_of d) {
      cells_.for_each_dart(facet, [&](Dart_of e) {
        if (is_convex && walker_.orientation() *
                                 signs_.orientation(cells_.point(d), cells_.end(d), *off, cells_.point(e)) <
                             0)
          is_convex = false;
      });
    });
    return is_convex;
  }

  Found across(Dart_of facet) const {
    Found found;
    const bool is_wall = walker_.is_impassable(facet);
    cells_.for_each_dart(facet, [&](Dart_of d) {
      if (walker_.is_impassable(d) != is_wall) found = Defect_kind::one_sided_wall;
      if (cells_.is_on_boundary(d)) return;
      const Dart_of other = cells_.opposite(d);
      if (walker_.is_impassable(other) != is_wall) found = Defect_kind::one_sided_wall;
      if (cells_.is_open(other) || cells_.point(d) != cells_.end(other) ||
          cells_.end(d) != cells_.point(other))
        found = Defect_kind::parted_facet;
    });
    return found;
  }

  const Walker<Lcc, Is_wall>& walker_;
  const Cells<Lcc>& cells_;
  const Signs<Lcc>& signs_;
};

}  // namespace detail

/// The first breach of what Walker requires of its map; none in one that is as required. Cells that overlap
/// each other, and facets that wind round twice, are not found: Environment::build() refuses both.
/// Cost: linear in the number of cells, quadratic in that of the facets and vertices of each. Takes a mark of
/// the map.
template <class Lcc, class Is_wall>
std::optional<Defect<Lcc>> find_defect(const Walker<Lcc, Is_wall>& walker) {
  Counts counts;
  const detail::Cells<Lcc> cells(walker.map());
  const detail::Signs<Lcc> signs(cells, walker.orientation(), counts);
  const detail::Defect_finder<Lcc, Is_wall> finder(walker, cells, signs);
  const auto darts = walker.map().darts();
  for (auto it = darts.begin(); it != darts.end(); ++it)
    if (const Dart<Lcc> d = it; cells.is_open(d)) return Defect<Lcc>{Defect_kind::open_cell, d};
  const auto representatives = walker.map().template one_dart_per_cell<Walker<Lcc, Is_wall>::D>();
  for (auto it = representatives.begin(); it != representatives.end(); ++it) {
    const auto facets = cells.facets(it);
    for (const Dart<Lcc>& facet : facets)
      if (const auto kind = finder.find(facet, facets)) return Defect<Lcc>{*kind, facet};
  }
  return {};
}

}  // namespace cellwalk::lcc

#endif  // CELLWALK_LCC_DEFECT_H
