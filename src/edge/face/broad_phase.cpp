// SPDX-License-Identifier: LGPL-3.0-or-later
// A flood from the first cell, by boxes and float planes of the facets of each block.
#include "broad_phase.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// Tests four points against the planes and facets of cells. Every certain answer is right.
class Box_and_plane_test {
 public:
  Box_and_plane_test(const Snapshot<3>& snapshot, const Corners& corners)
      : snapshot_(snapshot), low_(corners[0]), high_(corners[0]) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      Float_point<3> y;
      is_certain_ &= snapshot.frame().map(corners[k], y);
      lanes_[k] = spread<3>(y);
      for (std::size_t i = 0; i < 3; ++i) {
        low_[i] = std::min(low_[i], corners[k][i]);
        high_[i] = std::max(high_[i], corners[k][i]);
      }
    }
  }

  /// The facets (bits) of a block that have, or may have, points on both sides.
  unsigned may_part(const Plane_block<3>& block) const {
    if (!is_certain_) return all_lanes;
    unsigned inside = all_lanes, outside = all_lanes;
    for (const Spread_point<3>& y : lanes_) {
      const Float4 value = evaluate(block, y);
      inside &= lane_mask(value < -plane_error);
      outside &= lane_mask(value > plane_error);
    }
    return all_lanes & ~(inside | outside);
  }

  /// True if the boxes of the four points and of a facet are disjoint.
  bool is_apart(Cell c, std::size_t i) const {
    const Cell_view<3> cell = snapshot_.view(c);
    unsigned below = 7, above = 7;  // axes
    for (const std::uint16_t v : cell.loop(i)) {
      const Point<3>& x = cell.point(v);
      for (unsigned k = 0; k < 3; ++k) {
        if (x[k] >= low_[k]) below &= ~(1u << k);
        if (x[k] <= high_[k]) above &= ~(1u << k);
      }
    }
    return (below | above) != 0;
  }

 private:
  static constexpr unsigned all_lanes = 0xf;

  const Snapshot<3>& snapshot_;
  std::array<Spread_point<3>, 4> lanes_;
  bool is_certain_ = true;
  Point<3> low_, high_;
};

bool is_known(const Snapshot<3>& snapshot, const Candidate_walls& candidates, Half_facet wall) {
  const Half_facet other = snapshot.opposite(wall);
  return other != Half_facet::none &&
         std::find(candidates.walls.begin(), candidates.walls.end(), other) != candidates.walls.end();
}

}  // namespace

bool Cell_set::contains(Cell c) const {
  if (!index_.empty()) return index_.contains(c);
  return std::find(cells_.begin(), cells_.end(), c) != cells_.end();
}

void Cell_set::add(Cell c) {
  cells_.push_back(c);
  if (!index_.empty())
    index_.insert(c);
  else if (cells_.size() > most_searched)
    index_.insert(cells_.begin(), cells_.end());
}

void find_candidate_walls(const Snapshot<3>& snapshot, const Corners& corners, Candidate_walls& candidates,
                          Face_counts& counts) {
  const Box_and_plane_test probe(snapshot, corners);
  for (std::size_t head = 0; head < candidates.cells.size(); ++head) {
    const Cell c = candidates.cells[head];
    ++counts.flooded_cells;
    const std::size_t facets = snapshot.facet_count(c);
    for (std::size_t block = 0; block < snapshot.block_count(c); ++block) {
      const unsigned parted = probe.may_part(snapshot.blocks(c)[block]);
      for (std::size_t i = 4 * block; parted >> (i - 4 * block) != 0; ++i) {
        if (!(parted >> (i - 4 * block) & 1) || i >= facets) continue;
        const Half_facet f = Snapshot<3>::half_facet(c, i);
        const bool is_wall = snapshot.is_impassable(f);
        if (!is_wall && candidates.cells.contains(snapshot.neighbour(f))) continue;
        if (probe.is_apart(c, i)) continue;
        if (!is_wall)
          candidates.cells.add(snapshot.neighbour(f));
        else if (!is_known(snapshot, candidates, f))
          candidates.walls.push_back(f);
      }
    }
  }
}

}  // namespace cellwalk::detail
