// SPDX-License-Identifier: LGPL-3.0-or-later
// The replacement of some cells of a map by others. The snapshot is updated by Cell_patcher.
#ifndef CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H
#define CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H

#include <cellwalk/environment/map.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "environment/snapshot/cell_exchange.h"

namespace cellwalk {

/// First the darts are made that the new cells need besides those of the old ones; then apply() puts the
/// cells in, which cannot fail. Without it nothing is changed.
template <int D>
class Map_patch {
 public:
  /// \param snapshot still with the old cells
  /// \param exchange the new cells have points of the snapshot, see Snapshot::replace_cells()
  /// \param added a point of the new cells that is new, or no_point
  /// \pre the removed cells at a point are linked through facets that have it, walls included
  Map_patch(Map_storage<D>& storage, const Snapshot<D>& snapshot, const Cell_exchange<D>& exchange,
            std::uint32_t added);
  Map_patch(const Map_patch&) = delete;
  Map_patch& operator=(const Map_patch&) = delete;
  ~Map_patch();

  /// \param snapshot with the new cells; marks and indices are taken from it
  /// \param slots the half-facets of the facets of the soup
  void apply(const Snapshot<D>& snapshot, std::span<const Half_facet> slots);

  static constexpr std::uint32_t no_point = 0xffffffffu;

 private:
  void find_old(const Snapshot<D>& snapshot);
  void add_vertex(std::uint32_t point, Map_vertex<D> vertex);
  Map_vertex<D> vertex_of(std::uint32_t point) const;
  Dart<D> dart_outside(std::size_t facet) const;
  void set_vertices(const Snapshot<D>& snapshot);
  void link_cells();
  void link_across(std::size_t facet, Dart<D> other);
  void link_facets();
  void forget_old();
  void mark(const Snapshot<D>& snapshot, std::span<const Half_facet> slots);
  /// The first dart of a facet of the soup.
  Dart<D> first(std::size_t facet) const { return darts_[D == 2 ? facet : soup_.facet_begin[facet]]; }

  Map_storage<D>& storage_;
  const Cell_exchange<D>& exchange_;
  const Cell_soup<D>& soup_;
  std::uint32_t added_;
  Map_vertex<D> added_vertex_{};
  boost::container::small_vector<Half_facet, 64> removed_;
  /// Those of the soup; in front of them those of the removed cells, as many as there are or can be used.
  boost::container::small_vector<Dart<D>, 192> darts_;
  std::size_t old_darts_ = 0;  ///< in `darts_`
  boost::container::small_vector<Dart<D>, 16> surplus_;
  /// Of the removed cells, by point.
  boost::container::small_vector<std::pair<std::uint32_t, Map_vertex<D>>, 16> vertices_;
  /// Where the last of them is, plus one, by the last bits of their points.
  std::array<std::uint8_t, 64> place_{};
  /// From which the darts start.
  boost::container::small_vector<Map_vertex<D>, 192> origins_;
  bool is_applied_ = false;
};

extern template class Map_patch<2>;
extern template class Map_patch<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H
