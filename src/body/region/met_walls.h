// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls near a box, by a flood of clusters of cells. Theory: docs/bodies.md, clearance.
#ifndef CELLWALK_BODY_REGION_MET_WALLS_H
#define CELLWALK_BODY_REGION_MET_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_cluster.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clear_region.h"

namespace cellwalk::detail {

/// A wall whose box the box of a search meets.
template <int D>
struct Met_wall {
  float gap;  ///< between its box and the positions, along an axis
  const Facet_boxes<D>* boxes;
  std::uint32_t lane;

  Half_facet facet() const { return Half_facet{boxes->facets[lane]}; }
  bool is_met_by(const Frame_box<D>& box) const {
    for (std::size_t k = 0; k < D; ++k)
      if (boxes->low[k][lane] > box.high[k][0] || boxes->high[k][lane] < box.low[k][0]) return false;
    return true;
  }
};

/// Finds the walls that a box may meet in the clusters that it reaches from a cell. Those whose boxes meet
/// that of the positions are cut off at once, the others are listed: so end most searches in vain.
/// \param reach the box, \param kept that of the positions
/// \param cut returns false if a wall cannot be cut off: then the flood ends
/// Returns false if it ended so, or met more than the request allows.
template <int D, class Cut>
bool find_met_walls(const Snapshot<D>& snapshot, Cell first, const Frame_box<D>& reach,
                    const Frame_box<D>& kept, const Region_request<D>& request, Region_effort& effort,
                    std::vector<Met_wall<D>>& walls, const Cut& cut) {
  walls.clear();
  const auto look_at = [&](const Facet_boxes<D>& boxes) {
    const unsigned met = reach.met(boxes);
    if (met == 0) return true;
    Float4 gap{};
    for (std::size_t k = 0; k < D; ++k)
      gap = cellwalk::lane_max(gap,
                               cellwalk::lane_max(boxes.low[k] - kept.high[k], kept.low[k] - boxes.high[k]));
    for (unsigned left = met; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const Met_wall<D> wall{gap[lane], &boxes, static_cast<std::uint32_t>(lane)};
      ++effort.walls;
      if (wall.gap > 0)
        walls.push_back(wall);
      else if (!cut(wall.facet()))
        return false;
    }
    return true;
  };
  return flood_clusters(snapshot, first, reach, [&](const Cell_cluster<D>& cluster, std::size_t reached) {
    ++effort.cells;
    if (reached > request.most_cells || effort.walls > request.most_walls) {
      effort.is_exhausted = true;
      return false;
    }
    return std::ranges::all_of(cluster.walls, look_at, &Wall_lanes<D>::boxes);
  });
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_MET_WALLS_H
