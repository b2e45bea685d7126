// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue around an environment: solid tetrahedra from its boundary to a box, by TetGen. Walls of the
// boundary become inner facets, so that walls that move cannot run into each other.
#ifndef CELLWALK_INTERNAL_MESHING_TISSUE_H
#define CELLWALK_INTERNAL_MESHING_TISSUE_H

#include <cellwalk/meshing/mesher_limits.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>
#include <string>

namespace cellwalk {

struct Tissue_options {
  double thickness = 1;  ///< distance of the sides of the box from the cells, in units of these; positive
  double quality = 3;    ///< see Tetrahedralize_options; for solid cells
  std::size_t most_added_points = 1000000;  ///< refinement stops there
  Mesher_limits limits{};
};

struct Tissue_report {
  Point<3> low{}, high{};         ///< the corners of the box
  std::size_t solid_cells = 0;    ///< added
  std::size_t added_points = 0;   ///< on the box and in the tissue; none on the boundary of the cells
  std::size_t inner_facets = 0;   ///< triangles that were on the boundary, all preserved
  std::size_t out_of_bounds = 0;  ///< solid tetrahedra that violate the bound of quality
  std::string tolerance;          ///< see Tetrahedralize_report
};

/// Surrounds cells by solid tetrahedra. The cells stay as they are, with their points and numbers, and those
/// of the tissue come after them; it fills the box outside of the cells, cavities too, so that the result has
/// no boundary but the sides of the box. These are cut into triangles about as large as the thickness, with
/// at most 32 to an edge.
/// \pre the cells are exactly positive and do not overlap
/// \throw Error(usage) for a thickness that does not lie between 2^-16 and 2^10 of the diagonal of the cells,
///        or with which the box cannot be distinguished from the cells in double precision; for the quality
///        as tetrahedralize(); if there is no TetGen
/// \throw Error(input) if there are no cells, or a facet of their boundary is not a triangle
/// \throw Error(not_certified) as tetrahedralize(), also if parts of the boundary meet in one place without
///        sharing their points, as at slits
/// Degenerate cases: parts of the boundary may share edges and vertices (pinched ones).
/// Cost: about 20 us a tetrahedron of the box, those in place of the cells included.
Cell_soup<3> surround_by_tissue(Cell_soup<3> cells, const Tissue_options& options,
                                Tissue_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_MESHING_TISSUE_H
