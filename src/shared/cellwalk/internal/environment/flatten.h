// SPDX-License-Identifier: LGPL-3.0-or-later
// Flat arrays from the map, from which snapshots are compiled.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_FLATTEN_H
#define CELLWALK_INTERNAL_ENVIRONMENT_FLATTEN_H

#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <vector>

namespace cellwalk {

/// Cells read from a map.
template <int D>
struct Flat_cells {
  Cell_soup<D> soup;
  Gluing gluing;
  std::vector<Dart<D>> darts;  ///< first dart of each half-facet of the soup
};

/// All cells of a map in the order of their indices. The facets of a cell are in the order of their
/// half-facet numbers (3D) or around the cell from the lowest (2D); a loop starts at the first dart of its
/// half-facet. Impassable facets are marked on both sides, including those of the boundary. Directly after
/// build_map() the result is the soup from which the map was built.
/// Cost: about 0.4 us a tetrahedron on one core; parallel.
template <int D>
Flat_cells<D> flatten(const Map_storage<D>& storage);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_FLATTEN_H
