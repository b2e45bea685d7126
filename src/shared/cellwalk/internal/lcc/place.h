// SPDX-License-Identifier: LGPL-3.0-or-later
// The place of a point in a cell of a map, and the cells linked with it there.
#ifndef CELLWALK_INTERNAL_LCC_PLACE_H
#define CELLWALK_INTERNAL_LCC_PLACE_H

#include <cellwalk/internal/lcc/star.h>

#include <cstddef>
#include <optional>

namespace cellwalk::lcc::detail {

/// The lowest cell of the complex on which a point of a closed cell lies.
template <class Lcc>
struct Place {
  int dimension = 0;  ///< that of the map: inside the cell
  Dart<Lcc> dart{};   ///< of the facet or edge in the cell, or starting at the vertex; else any of the cell
};

template <class Lcc>
class Places {
 public:
  static constexpr int D = Cells<Lcc>::D;
  using Point = typename Lcc::Point;
  using Dart_of = Dart<Lcc>;

  explicit Places(const Signs<Lcc>& signs) : signs_(signs), cells_(signs.cells()) {}

  /// The place of a point in the cell of a dart; none outside the closed cell.
  std::optional<Place<Lcc>> find(Dart_of cell, const Point& x) const {
    const auto facets = cells_.facets(cell);
    typename Cells<Lcc>::Darts on;
    for (const Dart_of facet : facets) {
      const int side = signs_.side(facet, x);
      if (side > 0) return {};
      if (side == 0) on.push_back(facet);
    }
    if (on.empty()) return Place<Lcc>{D, cell};
    std::optional<Place<Lcc>> found;
    for (const Dart_of facet : on)
      cells_.for_each_dart(facet, [&](Dart_of d) {
        if (cells_.point(d) == x) found = {0, d};
        if (D == 2 && cells_.end(d) == x) found = {0, cells_.next(d)};
      });
    if (found) return found;
    if constexpr (D == 3)
      for (const Dart_of facet : on)
        cells_.for_each_dart(facet, [&](Dart_of d) {
          if (signs_.on_segment(cells_.point(d), cells_.end(d), x)) found = {1, d};
        });
    if (found) return found;
    // Several facets in one plane: the one that contains the point.
    for (const Dart_of facet : on)
      if (on.size() == 1 || is_in(facet, facets, x)) return Place<Lcc>{D - 1, facet};
    return Place<Lcc>{D - 1, on.front()};  // by rounded signs only
  }

  /// Calls visit(dart) with a dart of each cell linked at a point with that of the place, the latter first.
  template <class Is_wall, class Visit>
  void for_each_linked(const Place<Lcc>& place, const Is_wall& is_wall, const Visit& visit) const {
    if (place.dimension < D - 1) {
      Linked_cells<Lcc> linked(cells_, {place.dart, place.dimension == 0});
      linked.expand_all(is_wall);
      for (std::size_t k = 0; k < linked.size(); ++k) visit(linked[k].dart);
      return;
    }
    visit(place.dart);
    if (place.dimension == D - 1 && !is_wall(place.dart)) visit(cells_.opposite(place.dart));
  }

 private:
  bool is_in(Dart_of facet, const typename Cells<Lcc>::Darts& facets, const Point& x) const {
    if constexpr (D == 2) return signs_.on_segment(cells_.point(facet), cells_.end(facet), x);
    const Point* off = signs_.off_plane(facet, facets);
    bool is_inside = off;
    if constexpr (D == 3)
      cells_.for_each_dart(facet, [&](Dart_of d) {
        is_inside =
            is_inside &&
            signs_.map_orientation() * signs_.orientation(cells_.point(d), cells_.end(d), *off, x) >= 0;
      });
    return is_inside;
  }

  const Signs<Lcc>& signs_;
  const Cells<Lcc>& cells_;
};

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_PLACE_H
