// SPDX-License-Identifier: LGPL-3.0-or-later
// The combinatorial shape of a cell: its facets as loops of local vertex numbers. Cells of the same shape
// share it.
#ifndef CELLWALK_ENVIRONMENT_CELL_SHAPE_H
#define CELLWALK_ENVIRONMENT_CELL_SHAPE_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// Facets of a cell as loops of local vertex numbers, counterclockwise seen from outside (2D: the two ends of
/// an edge, counterclockwise around the cell).
struct Cell_shape {
  std::vector<std::uint16_t> loop_begin{0};  ///< loop of facet i: [loop_begin[i], loop_begin[i+1]) of loops
  std::vector<std::uint16_t> loops;          ///< local vertex numbers
  std::uint16_t vertex_count = 0;

  std::size_t facet_count() const { return loop_begin.size() - 1; }
  std::span<const std::uint16_t> loop(std::size_t i) const {
    return {loops.data() + loop_begin[i], loops.data() + loop_begin[i + 1]};
  }
  bool operator==(const Cell_shape&) const = default;
};

/// A non-owning view of the geometry of a cell: its shape and the positions of its local vertices.
template <int D>
struct Cell_view {
  const Cell_shape* shape;
  std::span<const std::uint32_t> vertices;  ///< point index of each local vertex
  std::span<const Point<D>> points;         ///< all points

  std::size_t facet_count() const { return shape->facet_count(); }
  std::span<const std::uint16_t> loop(std::size_t i) const { return shape->loop(i); }
  std::size_t vertex_count() const { return vertices.size(); }
  const Point<D>& point(std::size_t local_vertex) const { return points[vertices[local_vertex]]; }
  std::uint32_t point_index(std::size_t local_vertex) const { return vertices[local_vertex]; }
};

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_CELL_SHAPE_H
