// SPDX-License-Identifier: LGPL-3.0-or-later
// The plan of a split: the triangles into which facets of a soup are cut, and the points from which its cells
// are cut into tetrahedra. Internal to splitting.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_PLAN_H
#define CELLWALK_ENVIRONMENT_SPLIT_PLAN_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/environment/split.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <vector>

#include "star.h"

namespace cellwalk::detail {

/// A facet that is cut, in the same way on both sides.
struct Facet_cut {
  std::uint32_t half_facet;            ///< one of its sides
  std::array<std::uint32_t, 2> cells;  ///< both cells; twice the same on the boundary
  Triangulation triangles;             ///< in the direction of the canonical loop
};

/// The decisions about every facet with more than three vertices of every cell that is to be split, and about
/// every such cell.
class Split_plan {
 public:
  /// Cuts facets in the preferred way, searches for stars, and tries other cuts if there is none.
  /// \throw Error(not_certified) naming a cell that cannot be split, and the reason
  Split_plan(const Cell_soup<3>& soup, const std::vector<Cell_check>& checks, Cells_to_split which);

  bool is_split(std::size_t cell) const { return slot_of_cell_[cell] != none; }
  const Star& star(std::size_t cell) const { return stars_[slot_of_cell_[cell]]; }
  bool is_cut(std::size_t half_facet) const { return cut_of_facet_[half_facet] != none; }
  /// The triangles of a facet that is cut, counterclockwise seen from outside its cell.
  Triangulation triangles(std::size_t half_facet) const;
  /// All facets of a split cell as triangles.
  Triangulation surface(std::size_t cell) const;

  std::size_t split_cells() const { return split_cells_.size(); }
  std::size_t cut_facets() const { return cuts_.size(); }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  void cut_facets_of_split_cells();
  void find_stars();
  void repair();
  /// Searches for other cuts of the facets of one cell that give it a star and keep those of its neighbours.
  bool repair(std::uint32_t slot);
  /// True if a neighbour that shares a cut has no star yet; its repair may change the cut.
  bool has_open_neighbour(std::uint32_t slot) const;
  bool try_cuts(std::uint32_t slot, const std::vector<std::uint32_t>& cuts,
                const std::vector<const Triangulation*>& triangles);
  Star find_star_of(std::uint32_t slot) const;
  [[noreturn]] void refuse(std::size_t cell) const;

  const Cell_soup<3>& soup_;
  std::vector<std::uint32_t> split_cells_;   // ascending
  std::vector<std::uint32_t> slot_of_cell_;  // position in split_cells_, or none
  std::vector<std::uint32_t> cut_of_facet_;  // position in cuts_ of a half-facet's cut, or none
  std::vector<Facet_cut> cuts_;
  std::vector<Star> stars_;  // per split cell
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SPLIT_PLAN_H
