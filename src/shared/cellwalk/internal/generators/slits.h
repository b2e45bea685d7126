// SPDX-License-Identifier: LGPL-3.0-or-later
// Slits: pairs of coincident one-sided walls, as a cut leaves them.
#ifndef CELLWALK_INTERNAL_GENERATORS_SLITS_H
#define CELLWALK_INTERNAL_GENERATORS_SLITS_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <span>

namespace cellwalk {

/// Separates the cells at some facets: a facet of two cells becomes two coincident boundary facets, one of
/// each cell. Vertices inside a slit, and at its end on the boundary, are duplicated, one copy for each group
/// of cells that facets still join there. The rim of a slit in free space stays shared. If all vertices of a
/// facet stay shared (a slit of one facet), they would still identify one facet; then it is split at an
/// interior point, into triangles (2D: halves), on one side or on both. The point must be exact in doubles; a
/// facet without such a point becomes a membrane instead.
///
/// The result is for Environment::build() with Duplicate_vertices::keep. Cells and existing points keep their
/// indices.
/// \param is_slit marks the half-facets to be separated; a mark on one side suffices, and marks on the
///        boundary have no effect
/// \pre a soup of convex cells that can be glued; one mark for each half-facet
/// Cost: some us a cell.
template <int D>
void open_slits(Cell_soup<D>& soup, std::span<const std::uint8_t> is_slit);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_GENERATORS_SLITS_H
