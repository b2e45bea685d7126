// SPDX-License-Identifier: LGPL-3.0-or-later
// Conforming split of cells that are not exactly convex. Runs on the soup, before anything is glued.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_SPLIT_H
#define CELLWALK_INTERNAL_ENVIRONMENT_SPLIT_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// Which cells are split.
enum class Cells_to_split {
  invalid,           ///< those that are not exactly convex with exactly planar convex facets
  all_but_simplices  ///< the same, and all that are not tetrahedra (2D: triangles)
};

/// Splits every cell that is not exactly convex with exactly planar convex facets into tetrahedra (2D:
/// triangles). In 3D the facets of such a cell are split into triangles consistently on both sides; a valid
/// neighbour is not split, but then has several coplanar facets. The new cells inherit solidity and walls.
/// Points are only appended. Result cells are exactly positive, and those of one input cell do not overlap;
/// certify() checks the whole complex. The choice of facet diagonals, and so the result, depends on the input
/// only.
/// \param origin if not null, receives the input cell of each result cell
/// \param which whether valid cells are split as well that are no simplices; then all cells of the result are
/// \throw Error(not_certified) naming a cell that cannot be split (the same one for any number of threads),
///        and why; as glue, if a cell is split
/// \throw Error(input) for a vertex index out of range or a coordinate that is not finite
/// Cost: about 0.1 us a valid tetrahedron, 6 us a hexahedron that is split; parallel.
template <int D>
Cell_soup<D> split(Cell_soup<D> soup, Split_report& report, std::vector<std::uint32_t>* origin = nullptr,
                   Cells_to_split which = Cells_to_split::invalid);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_SPLIT_H
