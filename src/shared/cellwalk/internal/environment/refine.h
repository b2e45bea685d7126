// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells that do not conform get common facets: the part of a plane that two of them share becomes a facet of
// both. Runs on the soup, before anything is split or glued.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_REFINE_H
#define CELLWALK_INTERNAL_ENVIRONMENT_REFINE_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>

namespace cellwalk {

/// What a refinement changed; all zero if nothing.
struct Refinement {
  Facing_facets facing;           ///< the pairs of facets that overlapped; cells of the input
  std::size_t facets = 0;         ///< facets that were replaced by pieces
  std::size_t pieces = 0;         ///< the pieces
  std::size_t points_added = 0;   ///< where sides of facets cross
  std::size_t points_joined = 0;  ///< corners that were replaced by others within the tolerance
  double farthest = 0;            ///< the largest distance of two of these, rounded
};

/// Gives free cells that lie on each other common facets. Where boundary facets of two free cells have
/// opposite sides and overlap in a plane (2D: a line), both are replaced by their common parts and the
/// remainders, which are convex. The only new points are those where sides of two facets cross; they, and
/// corners that lie inside a side, become vertices of all facets with that side. Cells stay what they are,
/// but for vertices inside edges and several facets in a plane. Pieces are walls if their facet is marked as
/// one, and belong to its groups. Points in the same place count as one here, but are not merged.
///
/// A soup that cannot be glued, or whose cells overlap, is left unchanged, for Environment::build() to say
/// why. So are pairs with a solid cell, unless there is a tolerance: a wall parts them in any case.
/// \param soup,groups are changed; its cells keep their order
/// \param tolerance 0: decides exactly. Otherwise, as a part of the diagonal: facets within this distance of
///        each other overlap as well, and corners within it become one, so that cells need not be exactly
///        planar any more
/// \throw Error(not_certified) naming both cells and the place: without a tolerance, if doubles cannot
///        represent the point where two sides cross, or if facets that are not both marked as walls lie
///        within a billionth of the diagonal of each other, but do not touch (Facing_walls::near); with one,
///        if two corners of a cell would become one
/// Cost: that of glue(), and about 20 us for each pair of facets; half a second for a million tetrahedra that
/// conform.
template <int D>
Refinement refine(Cell_soup<D>& soup, Soup_groups& groups, double tolerance);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_REFINE_H
