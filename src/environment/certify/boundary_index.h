// SPDX-License-Identifier: LGPL-3.0-or-later
// An index of boundary facets by position, kept while an environment is edited. Internal.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_INDEX_H
#define CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_INDEX_H

#include <cellwalk/environment/snapshot.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {

template <int D>
using Box_corner = boost::geometry::model::point<double, D, boost::geometry::cs::cartesian>;
template <int D>
using Tree_box = boost::geometry::model::box<Box_corner<D>>;

/// The bounding box of points.
template <int D>
Tree_box<D> box_of(std::span<const Point<D>> points, std::span<const std::uint32_t> vertices);

/// The bounding box of cells.
/// \pre there is at least one
template <int D>
Tree_box<D> box_of(const Snapshot<D>& snapshot, std::span<const Cell> cells);

/// An R-tree over the boxes of all boundary facets. Does not refer to the snapshot.
template <int D>
class Boundary_index {
 public:
  /// A boundary facet and its box.
  using Entry = std::pair<Tree_box<D>, std::uint32_t>;

  /// Cost: linear in the number of facets, and a sort of those on the boundary.
  explicit Boundary_index(const Snapshot<D>& snapshot);

  /// The current boundary facets of cells.
  static std::vector<Entry> entries(const Snapshot<D>& snapshot, std::span<const Cell> cells);

  /// Updates the index after an edit: `old` are the entries of the changed cells before it, `now` those
  /// after.
  /// Cost: logarithmic in the size of the boundary for each entry that differs.
  void replace(std::span<const Entry> old, std::span<const Entry> now);

  /// The facets whose boxes meet a box, ascending.
  std::vector<Half_facet> meeting(const Tree_box<D>& box) const;

 private:
  boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>> tree_;
};

extern template class Boundary_index<2>;
extern template class Boundary_index<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_BOUNDARY_INDEX_H
