// SPDX-License-Identifier: LGPL-3.0-or-later
// Conforming split of cells that are not exactly convex. Runs on the soup, before anything is glued.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_H
#define CELLWALK_ENVIRONMENT_SPLIT_H

#include <cstddef>

#include <cellwalk/records/cell_soup.h>

namespace cellwalk {

/// What splitting did; zero throughout if every cell was fine.
struct Split_report {
  std::size_t cells_split = 0;          ///< input cells replaced
  std::size_t cells_made = 0;           ///< cells they were replaced by
  std::size_t facets_triangulated = 0;  ///< facets cut into triangles (both sides alike)
  std::size_t points_added = 0;         ///< interior points of stars
  std::size_t not_planar = 0;           ///< cells split because a facet is not exactly planar
  std::size_t not_convex = 0;           ///< cells split because they are planar but not exactly convex
};

/// Splits every cell that is not exactly convex with exactly planar convex facets, and, so that facets match
/// on both sides, those neighbours that share a facet cut by it. The cells of the result that replace cell c
/// keep its solidity, and its walls. `origin`, if given, receives the input cell of each result cell. \throw
/// Error(not_certified) naming the cell that cannot be split, and why
template <int D>
Cell_soup<D> split(Cell_soup<D> soup, Split_report& report, std::vector<std::uint32_t>* origin = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SPLIT_H
