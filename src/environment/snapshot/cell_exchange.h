// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells that go and those that come instead of them, and how these fit to the cells that stay.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_CELL_EXCHANGE_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_CELL_EXCHANGE_H

#include <cellwalk/environment/snapshot.h>

#include <boost/container/small_vector.hpp>

#include <span>

namespace cellwalk {

/// See Snapshot::replace_cells(). The objects that it refers to must outlive it.
template <int D>
struct Cell_exchange {
  using Half_facets = boost::container::small_vector<Half_facet, 64>;

  Cell_exchange(const Snapshot<D>& snapshot, std::span<const Cell> cells_removed, const Cell_soup<D>& cells,
                const Gluing& gluing_of_cells);

  std::span<const Cell> removed;
  const Cell_soup<D>& soup;
  const Gluing& gluing;
  /// Of each facet of the soup: that of a cell that stays with the same points, or Half_facet::none.
  Half_facets outside;
  /// Facets of cells that stay, beside which a cell goes and none comes.
  Half_facets left_open;
};

extern template struct Cell_exchange<2>;
extern template struct Cell_exchange<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_CELL_EXCHANGE_H
