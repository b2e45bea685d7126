// SPDX-License-Identifier: LGPL-3.0-or-later
// The two halves of check_cell: combinatorics, once per shape, and geometry, once per cell. Internal.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_SHAPE_H
#define CELLWALK_ENVIRONMENT_CERTIFY_SHAPE_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>

#include <array>
#include <cstdint>

namespace cellwalk::detail {

/// Checks that the facets form one closed oriented surface of Euler characteristic 2 (2D: one cycle). Does
/// not depend on the geometry.
template <int D>
Cell_check check_shape(const Cell_shape& shape);

/// The rest of check_cell.
/// \pre check_shape(*cell.shape) found no defect
template <int D>
Cell_check check_geometry(const Cell_view<D>& cell);

/// describe(), with the caller's name of the facet.
std::string describe(Cell_defect defect, const std::string& facet);

/// check_cell() for many cells in turn: caches the shapes found sound. One per thread; the shapes must stay
/// in place.
template <int D>
class Cell_checker {
 public:
  Cell_check operator()(const Cell_view<D>& cell) {
    const Cell_shape*& sound =
        sound_[reinterpret_cast<std::uintptr_t>(cell.shape) / sizeof(Cell_shape) % sound_.size()];
    if (sound != cell.shape) {
      const Cell_check check = check_shape<D>(*cell.shape);
      if (check.defect != Cell_defect::none) return check;
      sound = cell.shape;
    }
    return check_geometry<D>(cell);
  }

 private:
  std::array<const Cell_shape*, 16> sound_{};  // a few: most complexes have one or two shapes
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_SHAPE_H
