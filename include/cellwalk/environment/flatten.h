// SPDX-License-Identifier: LGPL-3.0-or-later
// The map back to flat arrays: what a snapshot is compiled from.
#ifndef CELLWALK_ENVIRONMENT_FLATTEN_H
#define CELLWALK_ENVIRONMENT_FLATTEN_H

#include <cellwalk/environment/gluing.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/records/cell_soup.h>

#include <span>
#include <vector>

namespace cellwalk {

/// Cells read from a map.
template <int D>
struct Flat_cells {
  Cell_soup<D> soup;
  Gluing gluing;
  std::vector<Dart<D>> darts;  ///< first dart of each half-facet of the soup
};

/// All cells of a map in the order of their indices. The facets of a cell come in the order of their half-facet
/// numbers (3D) or round the cell from the lowest (2D); a loop starts at the first dart of its half-facet. Impassable
/// is marked on both sides and on the boundary.
/// Right after build_map this is the soup that the map was built from.
/// Cost: about 0.4 us a tetrahedron on one core; parallel.
template <int D>
Flat_cells<D> flatten(const Map_storage<D>& storage);

/// The cells of the given darts, one dart a cell, in that order. Facets are in breadth-first order from the dart
/// (3D) or round the cell (2D). The gluing covers the given cells only; soup.points stays empty, vertices are the
/// points' indices.
template <int D>
Flat_cells<D> flatten_cells(Map_storage<D>& storage, std::span<const Dart<D>> cells);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_FLATTEN_H
