// SPDX-License-Identifier: LGPL-3.0-or-later
// The replacement of some cells of a map by others. The snapshot is updated by Cell_patcher.
#ifndef CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H
#define CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H

#include <cellwalk/environment/map.h>

#include <boost/container/small_vector.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {

/// First the darts of the new cells are made, beside the others; then apply() puts them in, which cannot
/// fail. Without it nothing is changed.
template <int D>
class Map_patch {
 public:
  /// \param removed all half-facets of the cells that go
  /// \param soup the new cells, of points of the snapshot, see Snapshot::replace_cells()
  /// \param added a point of `soup` that is new, or none
  /// \pre the removed cells at a point are linked through facets that have it, walls included
  Map_patch(Map_storage<D>& storage, std::span<const Half_facet> removed, const Cell_soup<D>& soup,
            const Gluing& gluing, std::uint32_t added);
  Map_patch(const Map_patch&) = delete;
  Map_patch& operator=(const Map_patch&) = delete;
  ~Map_patch();

  /// \param snapshot with the new cells; marks and indices are taken from it
  /// \param slots the half-facets of the facets of the soup
  void apply(const Snapshot<D>& snapshot, std::span<const Half_facet> slots);

  static constexpr std::uint32_t no_point = 0xffffffffu;

 private:
  using Key = boost::container::small_vector<std::uint32_t, 8>;
  /// A facet that joins a removed cell and one that stays: its points, sorted, and its first dart there.
  struct Open_facet {
    Key key;
    Dart<D> outside;
  };

  static Key key_of(std::span<const std::uint32_t> loop);
  void find_outside(std::span<const Half_facet> removed);
  void make_darts();
  void link_cells();
  void link_to_stay();
  void link_across(std::size_t facet, Dart<D> other);
  void set_vertices(const Snapshot<D>& snapshot);
  void forget_vertices();

  Map_storage<D>& storage_;
  const Cell_soup<D>& soup_;
  const Gluing& gluing_;
  std::uint32_t added_;
  Map_vertex<D> added_vertex_{};
  std::vector<Half_facet> removed_;
  std::vector<Dart<D>> old_darts_, new_darts_;
  std::vector<Dart<D>> first_;  ///< of each facet of the soup
  std::vector<Open_facet> open_;
  std::vector<std::pair<std::uint32_t, Map_vertex<D>>> vertices_;  ///< of the removed cells, by point
  std::vector<std::size_t> old_darts_at_;                          ///< of each of them
  bool is_applied_ = false;
};

extern template class Map_patch<2>;
extern template class Map_patch<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_MAP_PATCH_H
