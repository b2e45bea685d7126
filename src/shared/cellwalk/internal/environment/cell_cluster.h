// SPDX-License-Identifier: LGPL-3.0-or-later
// A cluster of cells: the boxes of its walls and passages, and floods through these. See cell_clusters.h.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H

#include <cellwalk/internal/environment/cell_clusters.h>
#include <cellwalk/internal/environment/planes.h>
#include <cellwalk/internal/kernel/box.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace cellwalk {

template <int D>
class Snapshot;

}  // namespace cellwalk

namespace cellwalk::detail {

/// Boxes of four facets, in the frame of the snapshot, rounded outwards. Lanes without a facet meet no box.
template <int D>
struct Facet_boxes {
  std::array<Float4, D> low, high;
  std::array<std::uint32_t, 4> facets;  ///< half-facets that are walls, or clusters behind passages

  /// Without a facet.
  static Facet_boxes none() {
    constexpr float far = std::numeric_limits<float>::infinity();
    Facet_boxes boxes;
    boxes.low.fill(Float4{far, far, far, far});
    boxes.high.fill(Float4{-far, -far, -far, -far});
    boxes.facets.fill(0);
    return boxes;
  }
  /// Makes a lane a box round those of all lanes of others.
  void enclose(std::size_t lane, const Facet_boxes& others) {
    for (std::size_t k = 0; k < D; ++k) {
      const Float4 &l = others.low[k], &h = others.high[k];
      low[k][lane] = std::min({l[0], l[1], l[2], l[3]});
      high[k][lane] = std::max({h[0], h[1], h[2], h[3]});
    }
  }
};

/// Four walls.
template <int D>
struct Wall_lanes {
  Facet_boxes<D> boxes = Facet_boxes<D>::none();
  Plane_block<D> planes{};

  /// Takes a wall of others.
  void set(std::size_t lane, const Wall_lanes& others, std::size_t from) {
    for (std::size_t k = 0; k < D; ++k) {
      boxes.low[k][lane] = others.boxes.low[k][from];
      boxes.high[k][lane] = others.boxes.high[k][from];
    }
    boxes.facets[lane] = others.boxes.facets[from];
    set_plane(lane, others.planes, from);
  }
  void set_plane(std::size_t lane, const Plane_block<D>& others, std::size_t from) {
    for (std::size_t k = 0; k < D; ++k) planes.normal[k][lane] = others.normal[k][from];
    planes.offset[lane] = others.offset[from];
  }
};

/// The walls of some cells, and what leads out of them.
template <int D>
struct Cell_cluster {
  std::vector<Wall_lanes<D>> walls;
  std::vector<Facet_boxes<D>> passages;
};

/// A box in the frame, rounded outwards, each bound in all lanes.
template <int D>
struct Frame_box {
  std::array<Float4, D> low, high;

  Frame_box(const Plane_frame<D>& frame, const Box<D>& box);
  /// The lanes whose boxes meet it, as a bit mask.
  unsigned met(const Facet_boxes<D>& boxes) const {
    Int4 all = boxes.low[0] <= high[0];
    for (std::size_t k = 0; k < D; ++k) {
      if (k > 0) all &= boxes.low[k] <= high[k];
      all &= low[k] <= boxes.high[k];
    }
    return lane_mask(all);
  }
};

/// The cluster of the blocks of cells from number * size on.
template <int D>
std::unique_ptr<const Cell_cluster<D>> make_cluster(const Snapshot<D>& snapshot, std::uint32_t number,
                                                    std::uint32_t size);

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

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H
