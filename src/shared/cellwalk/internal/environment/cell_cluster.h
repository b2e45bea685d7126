// SPDX-License-Identifier: LGPL-3.0-or-later
// A cluster of cells: the boxes of its walls and passages. See cell_clusters.h.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H

#include <cellwalk/internal/environment/planes.h>
#include <cellwalk/internal/kernel/box.h>

#include <array>
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
};

/// The block for the next facet of a list that has so many.
template <int D>
Facet_boxes<D>& next_block(std::vector<Facet_boxes<D>>& blocks, std::size_t facets) {
  if (facets % 4 == 0) blocks.push_back(Facet_boxes<D>::none());
  return blocks.back();
}

template <int D>
struct Cell_cluster {
  std::vector<Facet_boxes<D>> walls, passages;
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

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTER_H
