// SPDX-License-Identifier: LGPL-3.0-or-later
// Certification: proof by exact predicates that a complex is what the walk relies on. DESIGN:
// docs/certification.md.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_H
#define CELLWALK_ENVIRONMENT_CERTIFY_H

#include <cellwalk/environment/cell_shape.h>
#include <cellwalk/environment/snapshot.h>

#include <cstddef>
#include <string>

namespace cellwalk {

/// Why a cell is not acceptable, with the local facet concerned.
enum class Cell_defect {
  none,
  not_finite,        ///< a coordinate is infinite or not a number
  not_closed,        ///< facets do not form one closed surface (Euler characteristic 2)
  degenerate_facet,  ///< all vertices of a facet on one line
  facet_not_planar,
  facet_not_convex,  ///< not a convex polygon that turns once (collinear vertices are allowed)
  not_convex,        ///< a vertex lies strictly outside a facet
  inverted,          ///< all facets face inwards
  flat,              ///< zero volume
  wound              ///< coplanar facets overlap: the surface winds over itself
};

struct Cell_check {
  Cell_defect defect = Cell_defect::none;
  std::size_t facet = 0;  ///< local facet concerned, where one is
};

/// Exact check of one cell: planar convex facets, closed, convex, positively oriented, positive volume.
template <int D>
Cell_check check_cell(const Cell_view<D>& cell);

/// One line about a defect, without the cell's name: "facet 3 is not exactly planar".
std::string describe(const Cell_check& check);

/// What certification found: all conditions hold.
struct Certificate {
  std::size_t cells = 0, facets = 0;
  std::size_t ridges = 0;    ///< an edge (2D: a vertex) where n groups of cells meet counts n times
  std::size_t vertices = 0;  ///< points in use
  std::size_t solid_cells = 0;
  std::size_t walls = 0;  ///< impassable facets, the boundary included
  std::size_t boundary_facets = 0;
  std::size_t membranes = 0;           ///< impassable facets with free cells on both sides
  std::size_t components = 0;          ///< of free space, joined through passable facets
  std::size_t pinched_vertices = 0;    ///< vertices whose cells are not joined through facets that hold them
  double volume = 0, free_volume = 0;  ///< area in 2D; rounded
};

/// Certifies a snapshot:
/// - every cell by check_cell;
/// - the two sides of each facet match, boundary facets are walls, and walls part solid cells from free ones;
/// - no two vertices lie in the same place, unless allow_duplicates;
/// - cells turn exactly once round each inner ridge and at most once round each boundary ridge;
/// - no boundary facet has the interior of another cell on its inner side, so that cells do not overlap anywhere.
///
/// Why this is what the walk needs: docs/certification.md.
/// \throw Error(not_certified) naming the cell (its index in the input), the facet (its vertices) and the reason: of
///        the first of these conditions that does not hold, the lowest cell, for any number of threads
/// Cost: about 1.3 us a tetrahedron and core; parallel. About 45 bytes a tetrahedron of working memory.
template <int D>
Certificate certify(const Snapshot<D>& snapshot, bool allow_duplicates = false);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_H
