// SPDX-License-Identifier: LGPL-3.0-or-later
// Certification: a proof by exact predicates that a complex satisfies the assumptions of the walk. Theory:
// docs/certification.md.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_H
#define CELLWALK_ENVIRONMENT_CERTIFY_H

#include <cellwalk/environment/snapshot.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk {

/// The counts of a certified complex.
struct Certificate {
  std::size_t cells = 0, facets = 0;
  std::size_t ridges = 0;    ///< an edge (2D: a vertex) in which n groups of cells meet counts n times
  std::size_t vertices = 0;  ///< points in use
  std::size_t solid_cells = 0;
  std::size_t walls = 0;  ///< impassable facets, the boundary included
  std::size_t boundary_facets = 0;
  std::size_t membranes = 0;   ///< impassable facets with free cells on both sides
  std::size_t components = 0;  ///< of free space, joined through passable facets
  /// Vertices whose cells are not connected through facets that contain them.
  std::size_t pinched_vertices = 0;
  double volume = 0, free_volume = 0;  ///< area in 2D; rounded
};

/// The changes made by splitting; all zero if every cell was valid.
struct Split_report {
  std::size_t cells_split = 0;          ///< input cells replaced
  std::size_t cells_made = 0;           ///< cells they were replaced by
  std::size_t facets_triangulated = 0;  ///< facets split into triangles, consistently on both sides
  std::size_t points_added = 0;         ///< interior points of stars
  std::size_t not_planar = 0;           ///< cells split because a facet is not exactly planar
  std::size_t not_convex = 0;           ///< cells split because they are planar but not exactly convex
  std::size_t not_simplices = 0;        ///< valid cells split because simplices were requested
};

/// Pairs of boundary facets of two free cells that turn their outer sides to each other.
struct Facing_facets {
  std::size_t pairs = 0;
  /// Of the first pair, by the indices of the cells:
  std::array<std::uint32_t, 2> cells{};  ///< ascending
  std::vector<double> place;             ///< a point of both facets, D coordinates, rounded
  double distance = 0;                   ///< the largest where one facet lies over the other, rounded
};

/// Walls that part free cells although nothing lies between them, such as where a mesh does not conform.
struct Facing_walls {
  Facing_facets overlapping;  ///< their interiors have a point in common, by exact predicates
  Facing_facets near;         ///< others within `tolerance` of each other; rounded, and decides nothing
  /// A billionth of the diagonal, or the error of rounded coordinates if that is larger. In units of the
  /// environment.
  double tolerance = 0;
};

/// Certifies a snapshot:
/// - every cell by check_cell;
/// - the two sides of each facet match, boundary facets are walls, and walls separate solid cells from free
///   ones;
/// - no two vertices have the same coordinates, unless allow_duplicates;
/// - cells wind exactly once around each inner ridge and at most once around each boundary ridge;
/// - no boundary facet has the interior of another cell on its inner side, so that cells do not overlap
///   anywhere.
///
/// Proof that these conditions suffice: docs/certification.md.
/// \param facing if not null, receives the walls between free cells that nothing parts: they are not
///        refused here
/// \throw Error(not_certified) naming the cell (its index in the input), the facet (its vertices) and the
///        reason: the lowest cell that violates the first violated condition, for any number of threads
/// Cost: about 1.3 us a tetrahedron and core; parallel. About 45 bytes a tetrahedron of working memory.
template <int D>
Certificate certify(const Snapshot<D>& snapshot, bool allow_duplicates = false,
                    Facing_walls* facing = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_H
