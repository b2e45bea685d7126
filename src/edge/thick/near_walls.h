// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls near a hull of a few points, found by a flood from a cell. Theory: docs/radius.md, the nearest
// wall.
#ifndef CELLWALK_EDGE_THICK_NEAR_WALLS_H
#define CELLWALK_EDGE_THICK_NEAR_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_list.h>
#include <cellwalk/internal/kernel/box.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace cellwalk::detail {

/// Finds walls of cells that are reached through passable facets near a hull. Facets within the distance are
/// all passed, some others are, too; a flood that passes more finds other walls, but no less near ones.
///
/// Planes in lanes exclude most facets. A plane (n, d) with |n.y + d - g(y)| <= 3u in the frame for its exact
/// plane function g has a gradient of g of length (1 + 5u) at most, so where all corners of the hull have n.y
/// + d > R (1 + 2^-20) + plane_error, or all have it below the negative of that, all of the hull is more than
/// R away.
template <int D>
class Near_walls {
 public:
  /// \param hull the corners of the hull; it is referred to
  Near_walls(const Snapshot<D>& snapshot, std::span<const Point<D>> hull, double distance)
      : snapshot_(snapshot) {
    is_in_frame_ = true;
    for (const Point<D>& x : hull) {
      box_.extend(x);
      Float_point<D> y;
      is_in_frame_ &= snapshot.frame().map(x, y);
      corners_.push_back(spread<D>(y));
    }
    box_ = enlarged(box_, distance);
    const double in_frame =
        distance * snapshot.frame().scale * (1 + 0x1p-20) + static_cast<double>(plane_error);
    constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
    threshold_ = std::nextafter(static_cast<float>(std::min(in_frame, largest)),
                                std::numeric_limits<float>::infinity());
  }

  /// Calls use(wall) for each wall near the hull, seen from the free cell that the flood reached.
  /// \param start a free cell that contains a point of the hull
  /// \param cells receives the cells of the flood
  template <class Use>
  void visit(Cell start, Cell_list& cells, Use use) const {
    cells.assign(start);
    for (std::size_t next = 0; next < cells.size(); ++next) {
      const Cell cell = cells[next];
      const Cell_view<D> view = snapshot_.view(cell);
      for (std::size_t block = 0; block < snapshot_.block_count(cell); ++block) {
        for (unsigned near = lanes_near(snapshot_.blocks(cell)[block]); near != 0; near &= near - 1) {
          const std::size_t facet = 4 * block + static_cast<std::size_t>(std::countr_zero(near));
          if (facet >= view.facet_count()) break;
          const Half_facet half = Snapshot<D>::half_facet(cell, facet);
          const bool is_wall = snapshot_.is_impassable(half);
          const Cell neighbour = is_wall ? Cell::none : snapshot_.neighbour(half);
          if ((!is_wall && cells.contains(neighbour)) || !is_box_near(view, facet)) continue;
          if (is_wall)
            use(half);
          else
            cells.add(neighbour);
        }
      }
    }
  }

 private:
  unsigned lanes_near(const Plane_block<D>& block) const {
    if (!is_in_frame_) return 0xf;
    Float4 low = evaluate<D>(block, corners_[0]), high = low;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const Float4 at = evaluate<D>(block, corners_[i]);
      low = -lane_max(-low, -at);
      high = lane_max(high, at);
    }
    return ~lane_mask((low > threshold_) | (high < -threshold_)) & 0xf;
  }

  bool is_box_near(const Cell_view<D>& view, std::size_t facet) const {
    const auto loop = view.loop(facet);
    for (std::size_t k = 0; k < D; ++k) {
      bool is_below = true, is_above = true;
      for (const std::uint16_t v : loop) {
        const double x = view.point(v)[k];
        is_below &= x < box_.low[k];
        is_above &= x > box_.high[k];
      }
      if (is_below || is_above) return false;
    }
    return true;
  }

  const Snapshot<D>& snapshot_;
  Box<D> box_;
  boost::container::small_vector<Spread_point<D>, 4> corners_;
  float threshold_;
  bool is_in_frame_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_WALLS_H
