// SPDX-License-Identifier: LGPL-3.0-or-later
// The combinatorial map of a soup, and its consistency.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_BUILD_MAP_H
#define CELLWALK_INTERNAL_ENVIRONMENT_BUILD_MAP_H

#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>
#include <memory>
#include <span>

namespace cellwalk {

/// Builds the map of a glued soup. Half-facets get the numbers of the soup, which compiling a snapshot
/// replaces (assign_half_facets). A facet is marked impassable if either side is, on the boundary, and
/// between a solid and a free cell.
/// \pre gluing = glue(soup); every point is a vertex of some cell
/// \throw Error(not_certified) if the facets of a cell do not close up, naming the cell
/// Cost: about 0.8 us a tetrahedron on one core, 0.5 us on two; memory 681 bytes a tetrahedron.
template <int D>
std::unique_ptr<Map_storage<D>> build_map(const Cell_soup<D>& soup, const Gluing& gluing);

/// Renumbers all half-facets: the one that starts at darts[i] becomes half_facets[i].
/// \param slots the size of an array indexed by half-facets
template <int D>
void assign_half_facets(Map_storage<D>& storage, std::span<const Dart<D>> darts,
                        std::span<const Half_facet> half_facets, std::size_t slots);

/// The counts of a map.
struct Map_counts {
  std::size_t cells = 0, facets = 0, boundary_facets = 0, vertices = 0, darts = 0;

  bool operator==(const Map_counts&) const = default;
};

/// Checks every link of the map (inverses, involutions, both sides of facets and edges run against each
/// other, ends and marks agree) and that darts, half-facets, vertices and points refer to each other; counts
/// the cells.
/// \throw Error(other) naming the cell at fault: the map was damaged from outside
template <int D>
Map_counts check_map(const Map_storage<D>& storage);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_BUILD_MAP_H
