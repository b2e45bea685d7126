// SPDX-License-Identifier: LGPL-3.0-or-later
// A trace of hexahedra in a grid, with one byte of answers a move, as the methods replay it.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_TRACE_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_TRACE_H

#include <cellwalk/internal/records/body_trace.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::figure_8 {

/// Vertices of a body. Edges join vertex v to v^1, v^2 and v^4.
inline constexpr std::size_t trace_vertices = 8;
/// Edges at a vertex; edge k joins it to trace_neighbour(v, k).
inline constexpr std::size_t trace_edges = 3;

constexpr std::size_t trace_neighbour(std::size_t vertex, std::size_t k) {
  return vertex ^ (std::size_t{1} << k);
}

/// The vertices and edges of a body.
inline Traced_body hexahedron() {
  Traced_body body;
  body.vertices = trace_vertices;
  for (std::uint32_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (const auto w = static_cast<std::uint32_t>(trace_neighbour(v, k)); v < w)
        body.edges.push_back({v, w});
  return body;
}

/// Bits of the answer to the move of one vertex: set for hits.
/// The segment from the position of the vertex to its target
inline constexpr std::uint8_t trace_segment_bit = 1;
inline constexpr std::uint8_t trace_edge_bits = 0x0e;  ///< bit 1 + k: the segment from there to neighbour k
/// Bit 4 + k: the triangle of the motion and neighbour k.
inline constexpr std::uint8_t trace_triangle_bits = 0x70;

/// An answer from bits for the neighbours in ascending order.
inline std::uint8_t trace_answer(std::size_t vertex, bool is_blocked, unsigned edges, unsigned triangles) {
  unsigned answer = is_blocked ? trace_segment_bit : 0;
  for (std::size_t k = 0; k < trace_edges; ++k) {
    std::size_t place = 0;
    for (std::size_t j = 0; j < trace_edges; ++j)
      place += trace_neighbour(vertex, j) < trace_neighbour(vertex, k);
    answer |= (edges >> place & 1) << (1 + k) | (triangles >> place & 1) << (4 + k);
  }
  return static_cast<std::uint8_t>(answer);
}

/// A trace. The outer boundary of the grid is a wall, and so are the facets of obstacles.
struct Trace {
  std::uint32_t nx = 0, ny = 0, nz = 0;
  std::uint32_t bodies = 0, steps = 0;
  std::uint64_t seed = 0;
  double body_side = 0, speed = 0;  ///< in cells, and in cells a step

  std::vector<std::uint32_t> obstacles;   ///< indices of solid cells, ascending
  std::vector<Point<3>> start_positions;  ///< [body][vertex]
  std::vector<Point<3>> targets;          ///< [step][body][vertex]
  std::vector<std::uint8_t> answers;      ///< [step][body][vertex], exact

  std::uint64_t cells() const { return std::uint64_t{nx} * ny * nz; }
  std::uint64_t moves() const { return std::uint64_t{steps} * bodies * trace_vertices; }
};

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_TRACE_H
