// SPDX-License-Identifier: LGPL-3.0-or-later
// The clusters of cells that a box reaches. Theory: docs/bodies.md, clearance, and docs/radius.md, bodies.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CLUSTER_FLOOD_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CLUSTER_FLOOD_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_cluster.h>
#include <cellwalk/internal/environment/cell_clusters.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// Calls use(lane) for the lanes whose boxes a box meets.
template <int D, class Use>
void for_each_met(const Frame_box<D>& box, const Facet_boxes<D>& boxes, Use use) {
  for (unsigned met = box.met(boxes); met != 0; met &= met - 1)
    use(static_cast<std::size_t>(std::countr_zero(met)));
}

/// Calls use(cluster, number of clusters reached so far) for each cluster that is reached from that of a cell
/// through passages whose boxes a box meets, until it returns false.
/// Returns false if it did.
template <int D, class Use>
bool flood_clusters(const Snapshot<D>& snapshot, Cell first, const Frame_box<D>& box, Use use) {
  thread_local std::vector<std::uint32_t> reached;
  const Cell_clusters<D>& clusters = snapshot.clusters();
  reached.assign(1, clusters.cluster_of(snapshot, first));
  for (std::size_t head = 0; head < reached.size(); ++head) {
    const Cell_cluster<D>& cluster = clusters.cluster(snapshot, reached[head]);
    for (const Facet_boxes<D>& passages : cluster.passages)
      for_each_met(box, passages, [&](std::size_t lane) {
        const std::uint32_t next = passages.facets[lane];
        if (std::ranges::find(reached, next) == reached.end()) reached.push_back(next);
      });
    if (!use(cluster, reached.size())) return false;
  }
  return true;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CLUSTER_FLOOD_H
