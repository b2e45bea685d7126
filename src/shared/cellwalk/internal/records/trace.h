// SPDX-License-Identifier: LGPL-3.0-or-later
// A trace: a motion of bodies of 8 vertices in a grid of unit cubes, with the exact answer to every move, for
// comparisons with other libraries. The file format: docs/formats.md.
#ifndef CELLWALK_INTERNAL_RECORDS_TRACE_H
#define CELLWALK_INTERNAL_RECORDS_TRACE_H

#include <cellwalk/kernel/point.h>
#include <cellwalk/records/body_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// Vertices of a body of a trace. Edges join vertex v to v^1, v^2 and v^4.
constexpr std::size_t trace_vertices = 8;
/// Edges at a vertex; edge k joins it to trace_neighbour(v, k).
constexpr std::size_t trace_edges = 3;

constexpr std::size_t trace_neighbour(std::size_t vertex, std::size_t k) {
  return vertex ^ (std::size_t{1} << k);
}

/// The vertices and edges of a body of a trace.
inline Body_soup<3> trace_body_soup(std::span<const Point<3>, trace_vertices> positions) {
  Body_soup<3> soup;
  soup.points.assign(positions.begin(), positions.end());
  for (std::uint32_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (const auto w = static_cast<std::uint32_t>(trace_neighbour(v, k)); v < w)
        soup.edges.push_back({v, w});
  return soup;
}

/// Bits of the answer to the move of one vertex: set for hits.
/// The segment from the position of the vertex to its target
constexpr std::uint8_t trace_segment_bit = 1;
constexpr std::uint8_t trace_edge_bits = 0x0e;      ///< bit 1 + k: the segment from there to neighbour k
constexpr std::uint8_t trace_triangle_bits = 0x70;  ///< bit 4 + k: the triangle of the motion and neighbour k
constexpr std::uint8_t trace_all_bits = trace_segment_bit | trace_edge_bits | trace_triangle_bits;

/// A trace. Cell (ix,iy,iz) of the grid is the unit cube there, its index ix + nx (iy + ny iz); the outer
/// boundary is a wall, and so are the facets of obstacle cells. Targets may lie outside.
struct Trace {
  std::uint32_t nx = 0, ny = 0, nz = 0;
  std::uint32_t bodies = 0, steps = 0;
  std::uint64_t seed = 0;
  double obstacle_fraction = 0, body_side = 0, speed = 0;  ///< origin of the trace; nothing depends on them

  std::vector<std::uint32_t> obstacles;   ///< indices of solid cells, ascending
  std::vector<Point<3>> start_positions;  ///< [body][vertex]
  std::vector<Point<3>> targets;          ///< [step][body][vertex]
  std::vector<std::uint8_t> answers;      ///< [step][body][vertex], exact

  std::uint64_t cells() const { return std::uint64_t{nx} * ny * nz; }
  std::uint64_t moves() const { return std::uint64_t{steps} * bodies * trace_vertices; }

  /// The index of a vertex in the targets and answers.
  /// \pre step, body and vertex are in range
  std::size_t index(std::size_t step, std::size_t body, std::size_t vertex) const {
    return (step * bodies + body) * trace_vertices + vertex;
  }
  const Point<3>& start(std::size_t body, std::size_t vertex) const {
    return start_positions[body * trace_vertices + vertex];
  }
  const Point<3>& target(std::size_t step, std::size_t body, std::size_t vertex) const {
    return targets[index(step, body, vertex)];
  }
  std::uint8_t answer(std::size_t step, std::size_t body, std::size_t vertex) const {
    return answers[index(step, body, vertex)];
  }
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_TRACE_H
