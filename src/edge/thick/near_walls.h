// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls near a hull of a few points, found by a flood from a cell. Theory: docs/radius.md, the nearest
// wall.
#ifndef CELLWALK_EDGE_THICK_NEAR_WALLS_H
#define CELLWALK_EDGE_THICK_NEAR_WALLS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_list.h>
#include <cellwalk/internal/kernel/box.h>

#include <bit>
#include <cstddef>
#include <span>

#include "hull_in_frame.h"

namespace cellwalk::detail {

/// Finds walls of cells that are reached through passable facets near a hull. Facets within the distance are
/// all passed, some others are, too; a flood that passes more finds other walls, but no less near ones.
/// Planes in lanes exclude most facets.
template <int D>
class Near_walls {
 public:
  /// \param hull the corners of the hull; it is referred to
  Near_walls(const Snapshot<D>& snapshot, std::span<const Point<D>> hull, double distance)
      : snapshot_(snapshot), hull_(snapshot.frame(), hull, distance) {
    for (const Point<D>& x : hull) box_.extend(x);
    box_ = enlarged(box_, distance);
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
        for (unsigned near = hull_.lanes_near(snapshot_.blocks(cell)[block]); near != 0; near &= near - 1) {
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
  Hull_in_frame<D> hull_;
  Box<D> box_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_NEAR_WALLS_H
