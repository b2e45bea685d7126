// SPDX-License-Identifier: LGPL-3.0-or-later
// The number of cells that edges of a given length lie in: a measure of the cost of walks in an environment.
#ifndef CELLWALK_QUERY_EDGE_CELLS_H
#define CELLWALK_QUERY_EDGE_CELLS_H

#include <cellwalk/environment/snapshot.h>

#include <cstddef>
#include <cstdint>

namespace cellwalk {

struct Edge_cells_options {
  /// Of the edges; 0: a tenth of the mean distance between walls.
  double length = 0;
  std::size_t edges = 4096;  ///< random edges to walk along
  std::uint64_t seed = 1;
};

struct Edge_cells {
  double length = 0;  ///< of the edges
  /// The mean length of the segments in which random lines meet free space: 4 V / A for the volume V of free
  /// space and the area A of its walls, pi V / A for area and length in 2D (Cauchy and Crofton).
  double wall_distance = 0;
  std::size_t edges = 0;      ///< that lie in free space
  std::size_t blocked = 0;    ///< others that met a wall, and are left out
  double cells = 0;           ///< mean number of cells of an edge; 0 if there is no edge
  double standard_error = 0;  ///< of this mean
};

/// Walks exactly along random edges of a length that lie in free space, and counts their cells. Each has one
/// end at a random point of free space, uniformly distributed, and a random direction. Edges that meet a wall
/// are left out. If most edges do, it gives up after eight times as many as requested.
///
/// In cells whose facets have an area of F in the volume V, an edge of length L far from walls lies in
/// 1 + L F / (2 V) cells on average, in 2D in 1 + 2 L F / (pi V).
/// \throw Error(usage) unless options.length is finite and at least 0
/// Degenerate cases: no edge, and a wall distance of 0, if there is no free space, or if its volume or the
/// area of its walls is not a positive finite double. The cells are those that a walk visits: an edge through
/// a ridge or vertex does not lie in all of the cells there.
/// Cost: linear in the number of cells, about 0.3 us each, and 4096 walks. The same geometry, in the same
/// order of cells, gives the same numbers.
template <int D>
Edge_cells count_edge_cells(const Snapshot<D>& snapshot, const Edge_cells_options& options = {});

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_EDGE_CELLS_H
