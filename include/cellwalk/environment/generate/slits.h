// SPDX-License-Identifier: LGPL-3.0-or-later
// Slits: two one-sided walls in one place, cut into a complex as a blade would cut them.
#ifndef CELLWALK_ENVIRONMENT_GENERATE_SLITS_H
#define CELLWALK_ENVIRONMENT_GENERATE_SLITS_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <span>

namespace cellwalk {

/// Parts the cells at some facets: what was one facet of two cells becomes two facets of the boundary, one of each cell, in the same
/// place. Vertices inside a slit, and where it ends at the boundary, are duplicated, one copy for each group of cells that
/// facets still join there; its rim, where it ends in free space, stays shared. Where all vertices of a facet stay
/// shared (a slit of one facet) they would name one facet still: then it is cut about a point inside it, into triangles (2D: halves), as
/// seen from the one cell, from the other, or from both. That point is taken where doubles hold it exactly; a facet in
/// which no such point is found becomes a membrane instead.
///
/// `is_slit` says of each half-facet whether it is to be parted; marks on one side suffice, and those on the boundary are without effect.
/// The result is for Environment::build with Duplicate_vertices::keep. Cells and the points that were there keep their indices.
/// \pre a soup of convex cells that can be glued; one mark a half-facet
/// Cost: some us a cell.
template <int D>
void open_slits(Cell_soup<D>& soup, std::span<const std::uint8_t> is_slit);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_GENERATE_SLITS_H
