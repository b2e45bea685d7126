// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/flood.h>
#include <cellwalk/internal/edge/may_intersect.h>

namespace cellwalk {

template <int D>
bool is_free_of_walls(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle,
                      Edge_counts& counts, std::size_t most_cells) {
  detail::Flooded found;
  const auto no_wall = [](Half_facet) { return false; };
  if (!detail::flood(snapshot, start, triangle, counts, most_cells, found, no_wall)) return false;
  ++counts.clear;
  return true;
}

template bool is_free_of_walls<2>(const Snapshot<2>&, Cell, const Swept_triangle<2>&, Edge_counts&,
                                  std::size_t);
template bool is_free_of_walls<3>(const Snapshot<3>&, Cell, const Swept_triangle<3>&, Edge_counts&,
                                  std::size_t);

}  // namespace cellwalk
