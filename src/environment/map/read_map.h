// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells of a map that its user edited, and which of them the snapshot has.
#ifndef CELLWALK_ENVIRONMENT_MAP_READ_MAP_H
#define CELLWALK_ENVIRONMENT_MAP_READ_MAP_H

#include <cellwalk/environment/map.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk {

/// Cells and points in order: those that the snapshot has as they are by their indices, then the others.
template <int D>
struct Read_map {
  static constexpr std::uint32_t none = 0xffffffffu;

  Cell_soup<D> soup;
  Gluing gluing;                      ///< that of the map: facets of equal points need not be sewn
  std::vector<Dart<D>> darts;         ///< a dart of each half-facet, the first of its loop
  std::vector<Half_facet> before;     ///< the name of each half-facet in the snapshot, or none
  std::vector<std::uint32_t> points;  ///< the index of each point of the snapshot in the soup, or none
  std::vector<std::pair<Map_vertex<D>, std::uint32_t>> vertices;  ///< of the map, with their points
};

/// Reads a map that its user edited by operations of CGAL. Darts that these made have an empty Dart_info: a
/// facet is a wall if any of its darts is marked impassable, and a cell is solid if any of its darts is
/// marked so.
/// \param storage whose map was edited; its other members are those of before
/// \param snapshot of before
/// \throw Error(not_certified) with the place of a dart without a neighbour in its cell, or without a vertex;
///        Error(input) for a vertex that is not finite. Darts may be left with other half-facets then.
/// Cost: linear in the number of darts. Takes a mark of the map.
template <int D>
Read_map<D> read_map(Map_storage<D>& storage, const Snapshot<D>& snapshot);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_READ_MAP_H
