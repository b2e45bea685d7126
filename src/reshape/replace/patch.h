// SPDX-License-Identifier: LGPL-3.0-or-later
// Simplices that are to replace others over the same region.
#ifndef CELLWALK_RESHAPE_REPLACE_PATCH_H
#define CELLWALK_RESHAPE_REPLACE_PATCH_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/gluing.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quality.h"

namespace cellwalk::detail {

template <int D>
struct Patch {
  using Simplex = std::array<std::uint32_t, static_cast<std::size_t>(D) + 1>;

  std::vector<Cell> removed;
  std::vector<Simplex> cells;     ///< their points, in an order of positive orientation
  std::optional<Point<D>> added;  ///< a new point, which cells name by Snapshot::next_point()
  bool covers = false;  ///< known: facets between the removed cells are passable, and all others stay

  Corners_of_simplex<D> corners(const Snapshot<D>& snapshot, const Simplex& cell) const;
};

/// The points of a simplex, in an order of positive orientation.
/// \pre it has D + 1 points
template <int D>
typename Patch<D>::Simplex corners_of(const Snapshot<D>& snapshot, Cell cell);

/// Why a patch cannot be made; empty if it can: the new cells are positive, the facets between the old ones
/// are passable, and both have the same facets to all other cells, with the same sense. Then they cover the
/// same region.
/// \param soup receives the new cells
/// \param gluing receives their gluing
template <int D>
std::string check_patch(const Snapshot<D>& snapshot, const Patch<D>& patch, Cell_soup<D>& soup,
                        Gluing& gluing);

extern template struct Patch<2>;
extern template struct Patch<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_PATCH_H
