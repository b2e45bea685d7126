// SPDX-License-Identifier: LGPL-3.0-or-later
// A body trace: the motion of any bodies in any environment, with the exact answer to every move, for
// comparisons with other libraries. The file format: docs/formats.md.
#ifndef CELLWALK_INTERNAL_RECORDS_BODY_TRACE_H
#define CELLWALK_INTERNAL_RECORDS_BODY_TRACE_H

#include <cellwalk/kernel/point.h>
#include <cellwalk/records/body_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk {

/// Bits of the answer to the motion of a vertex or an edge: set for hits or, where the edge has a radius, if
/// a wall is nearer than that.
constexpr std::uint8_t body_trace_blocked = 1;  ///< the segment of the vertex, or the edge at its end
constexpr std::uint8_t body_trace_swept = 2;    ///< the triangle that the edge sweeps
constexpr std::uint8_t body_trace_bits = body_trace_blocked | body_trace_swept;

/// A body of a trace: its numbers of vertices, edges and faces, whose vertices are numbered within the body.
struct Traced_body {
  std::uint32_t vertices = 0;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< ascending, the lower vertex first
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<double> radii = {};  ///< in the form of Body_soup::radii
};

/// The number of edges of each vertex.
inline std::vector<std::uint32_t> degrees(const Traced_body& body) {
  std::vector<std::uint32_t> degrees(body.vertices);
  for (const auto& edge : body.edges)
    for (const std::uint32_t v : edge) ++degrees[v];
  return degrees;
}

/// A grid of unit cubes. Cell (ix,iy,iz) is the cube there, its index ix + nx (iy + ny iz). The outer
/// boundary is a wall, and so are the facets of solid cells.
struct Traced_grid {
  std::array<std::uint32_t, 3> cells{};  ///< nx, ny, nz
  std::vector<std::uint32_t> solid;      ///< their indices, ascending

  /// \pre 64 bits hold it
  std::uint64_t cell_count() const { return std::uint64_t{cells[0]} * cells[1] * cells[2]; }
};

/// A trace of bodies. Before step s all vertices stand at before[s]; then they move, body by body and vertex
/// by vertex.
struct Body_trace {
  bool touch_blocks = false;        ///< a wall that is only touched is in the way, too
  std::optional<Traced_grid> grid;  ///< the environment, if the trace has its own
  std::vector<Traced_body> bodies;
  std::uint32_t steps = 0;
  std::vector<Point<3>> before;   ///< [step][vertex of all bodies], and after the last step
  std::vector<Point<3>> targets;  ///< [step][vertex of all bodies]
  /// [step][answer]: of each vertex, then of its edges; empty if there are none.
  std::vector<std::uint8_t> answers;

  /// The vertices of all bodies.
  std::size_t vertices() const {
    std::size_t count = 0;
    for (const Traced_body& body : bodies) count += body.vertices;
    return count;
  }
  /// The answers of a step: one a vertex, and one for either end of an edge.
  std::size_t answers_of_step() const {
    std::size_t count = 0;
    for (const Traced_body& body : bodies) count += body.vertices + 2 * body.edges.size();
    return count;
  }
  std::size_t moves() const { return steps * vertices(); }
  bool has_radii() const {
    return std::ranges::any_of(bodies, [](const Traced_body& body) { return !body.radii.empty(); });
  }

  /// Positions of all vertices before a step.
  /// \pre step <= steps
  std::span<const Point<3>> before_step(std::size_t step) const {
    return std::span(before).subspan(step * vertices(), vertices());
  }
  std::span<const Point<3>> targets_of_step(std::size_t step) const {
    return std::span(targets).subspan(step * vertices(), vertices());
  }
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_BODY_TRACE_H
