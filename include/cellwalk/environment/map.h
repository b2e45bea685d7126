// SPDX-License-Identifier: LGPL-3.0-or-later
// The combinatorial map of an environment, which edits change and from which snapshots are compiled. Includes
// CGAL; users link CGAL::CGAL. Walks do not need this header.
//
// A cell of dimension D is a set of darts. A half-facet is a loop of darts in 3D, one dart in 2D; the first
// of them identifies it. beta_D joins the two sides of a facet, walls included: impassable facets are marked,
// not unglued.
#ifndef CELLWALK_ENVIRONMENT_MAP_H
#define CELLWALK_ENVIRONMENT_MAP_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/cell_soup.h>

#include <CGAL/Cell_attribute_with_point.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Linear_cell_complex_traits.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {

/// The information of a dart, in 8 bytes that CGAL would use for padding (681 bytes a tetrahedron in total).
class Dart_info {
 public:
  static constexpr std::uint32_t most_half_facets = 1u << 29;

  Dart_info() = default;
  /// \pre half_facet < most_half_facets
  Dart_info(std::uint32_t cell, std::uint32_t half_facet, bool impassable, bool solid)
      : cell_(cell),
        half_facet_(half_facet & (most_half_facets - 1)),
        impassable_(impassable),
        solid_(solid) {}

  std::uint32_t cell() const { return cell_; }              ///< index of the input cell
  std::uint32_t half_facet() const { return half_facet_; }  ///< slot in Map_storage::dart_of_half_facet
  bool is_impassable() const { return impassable_; }        ///< of the facet; equal on both sides
  bool is_solid() const { return solid_; }                  ///< of the cell

  void set_cell(std::uint32_t cell) { cell_ = cell; }
  void set_half_facet(std::uint32_t half_facet) { half_facet_ = half_facet & (most_half_facets - 1); }
  void set_impassable(bool impassable) { impassable_ = impassable; }
  void set_solid(bool solid) { solid_ = solid; }

  bool operator==(const Dart_info&) const = default;

 private:
  std::uint32_t cell_ = 0;
  std::uint32_t half_facet_ : 29 = 0;
  std::uint32_t impassable_ : 1 = 0;
  std::uint32_t solid_ : 1 = 0;
};
static_assert(sizeof(Dart_info) == 8);

/// Darts have a Dart_info, vertices a point and the index of the point in the soup and snapshot. A pinched
/// vertex (cells that touch in a vertex, not through facets) has one attribute for each of its parts, with
/// equal indices.
struct Map_items {
  template <class Complex>
  struct Dart_wrapper {
    using Dart_info = cellwalk::Dart_info;
    using Vertex_attribute = CGAL::Cell_attribute_with_point<Complex, std::uint32_t>;
    using Attributes = std::tuple<Vertex_attribute>;
  };
};

using Map_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <int D>
using Map =
    CGAL::Linear_cell_complex_for_combinatorial_map<D, D, CGAL::Linear_cell_complex_traits<D, Map_kernel>,
                                                    Map_items>;

/// A point of the map.
inline Map<2>::Point to_map_point(const Point<2>& p) { return {p[0], p[1]}; }
inline Map<3>::Point to_map_point(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// CGAL calls them handles up to 5.5 and descriptors from 5.6 on.
template <int D>
using Dart = decltype(std::declval<Map<D>&>().create_dart());
template <int D>
using Const_dart = decltype(std::declval<const Map<D>&>().darts().begin());
template <int D>
using Map_vertex = decltype(std::declval<Map<D>&>().create_vertex_attribute());

/// The map with its indices. It cannot be copied or moved, since darts are addresses.
template <int D>
struct Map_storage {
  Map_storage() = default;
  Map_storage(const Map_storage&) = delete;
  Map_storage& operator=(const Map_storage&) = delete;

  Map<D> map;
  std::size_t cell_count = 0;
  std::size_t cell_slots = 0;  ///< upper bound of the indices of cells, see Snapshot::cell_slots()
  /// First dart of each half-facet of the snapshot; Dart<D>{} for unused slots.
  std::vector<Dart<D>> dart_of_half_facet;
  /// The vertex of each point: of its lowest cell, if the point is pinched; Map_vertex<D>{} of one that an
  /// edit removed.
  std::vector<Map_vertex<D>> vertex_of_point;
  /// The other vertices of pinched points, sorted by point.
  std::vector<std::pair<std::uint32_t, Map_vertex<D>>> pinched;

  /// Index of the point a dart starts from.
  std::uint32_t point_of(Const_dart<D> d) const { return map.template info<0>(d); }
  /// All vertices of a point: more than one if it is pinched, none if it was removed.
  std::vector<Map_vertex<D>> vertices_of(std::uint32_t point) const;
};

/// Calls f on each dart of the half-facet that starts at d.
template <int D, class Any_map, class Any_dart, class F>
void for_each_dart_of_half_facet(Any_map& map, Any_dart d, const F& f) {
  if constexpr (D == 2) {
    f(d);
  } else {
    Any_dart e = d;
    do {
      f(e);
      e = map.template beta<1>(e);
    } while (e != d);
  }
}

extern template struct Map_storage<2>;
extern template struct Map_storage<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_H
