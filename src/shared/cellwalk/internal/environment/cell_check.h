// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether a cell is exactly convex, with exactly planar convex facets.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_CHECK_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_CHECK_H

#include <cellwalk/environment/snapshot.h>

#include <cstddef>
#include <string>

namespace cellwalk {

/// The defect of a cell.
enum class Cell_defect {
  none,
  not_finite,        ///< a coordinate is infinite or not a number
  not_closed,        ///< the facets do not form one closed surface (Euler characteristic 2)
  degenerate_facet,  ///< all vertices of a facet are collinear
  facet_not_planar,
  facet_not_convex,  ///< not a convex polygon that winds once (collinear vertices are allowed)
  not_convex,        ///< a vertex lies strictly outside a facet
  inverted,          ///< all facets face inwards
  flat,              ///< zero volume
  wound              ///< coplanar facets overlap: the surface winds over itself
};

struct Cell_check {
  Cell_defect defect = Cell_defect::none;
  std::size_t facet = 0;  ///< the local facet concerned, if any
};

/// Checks one cell exactly: planar convex facets, closed, convex, positively oriented, positive volume.
template <int D>
Cell_check check_cell(const Cell_view<D>& cell);

/// A one-line description of a defect, without the cell: "facet 3 is not exactly planar".
std::string describe(const Cell_check& check);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_CHECK_H
