// SPDX-License-Identifier: LGPL-3.0-or-later
// Local changes of the map. The snapshot is updated by Environment.
#ifndef CELLWALK_ENVIRONMENT_MAP_EDIT_MAP_H
#define CELLWALK_ENVIRONMENT_MAP_EDIT_MAP_H

#include <cellwalk/environment/map.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// The cells around a point.
template <int D>
struct Star {
  std::vector<Dart<D>> darts;  ///< one dart of each cell, which starts from the point
  bool on_boundary = false;    ///< the point lies on the boundary of the complex
};

/// Cost: that of the cells found.
template <int D>
Star<D> find_star(Map_storage<D>& storage, std::uint32_t point);

/// Replaces a cell by the star of a new vertex inside it: a pyramid over each of its facets (2D: a triangle
/// over each edge) with the new vertex as its apex. The facets between them are passable. `facets` are the
/// first darts of all half-facets of the cell. Afterwards each of them lies in one of the new cells, and
/// identifies it. New darts have the cell and half-facet of the old cell until they are renumbered. If memory
/// runs out, nothing is changed.
/// Cost: constant (linear in the size of the cell).
template <int D>
Map_vertex<D> insert_vertex_in_cell(Map_storage<D>& storage, std::span<const Dart<D>> facets,
                                    std::uint32_t point, const Point<D>& position);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_EDIT_MAP_H
