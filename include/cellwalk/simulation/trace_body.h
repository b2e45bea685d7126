// SPDX-License-Identifier: LGPL-3.0-or-later
// A body of a trace among walls, moved by the rule of traces: a vertex whose motion, or an edge of which
// after it, hits a wall stays where it is. The rule: docs/formats.md.
#ifndef CELLWALK_SIMULATION_TRACE_BODY_H
#define CELLWALK_SIMULATION_TRACE_BODY_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/records/trace.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk {

/// What the moves of bodies of traces did. All counts are machine-independent.
struct Trace_counts {
  std::uint64_t moves = 0;          ///< of vertices
  std::uint64_t vertex_hits = 0;    ///< moves in which the vertex hits: bit 0
  std::uint64_t edge_hits = 0;      ///< edges that hit at the target: bits 1 to 3
  std::uint64_t triangle_hits = 0;  ///< triangles of them that hit, if triangles are swept: bits 4 to 6
  std::uint64_t rounds = 0;  ///< edges that went round an obstacle: their triangle hits, and they do not
  std::uint64_t held = 0;    ///< moves after which the vertex stays where it was
  Edge_counts edges;

  Trace_counts& operator+=(const Trace_counts& other);
};

/// The vertices of a body of a trace.
using Trace_positions = std::span<const Point<3>, trace_vertices>;

/// One body. Refers to the snapshot, which must outlive it. Copies are bodies of their own.
class Trace_body {
 public:
  /// Registers a body where it stands.
  /// \throw Error(outside) naming the vertex that is not in free space, or the edge that
  /// crosses a wall
  Trace_body(const Snapshot<3>& snapshot, const Locator<3>& locator, Trace_positions positions);

  /// The answer to the move of one vertex, and its contact: that of the vertex if it hits, else the first one
  /// of its edges.
  struct Move {
    std::uint8_t answer = 0;
    std::optional<Contact<3>> contact;
  };

  /// Moves one vertex to a target, or leaves it where it is. The answer has bits 0 to 3 with
  /// Sweep::three_segments, and bits 4 to 6 as well with Sweep::triangle; which one is asked for does not
  /// change what moves.
  /// \pre the target is finite; `sweep` is one of these two
  /// \throw Error(usage) if the environment was edited since the body was made
  /// Degenerate cases: touching a wall is no hit, see sweep_triangle(); an edge that lies in a wall keeps its
  /// side of it.
  /// Cost: that of a walk and the sweeps of three edges.
  Move move(std::size_t vertex, const Point<3>& target, Sweep sweep, Trace_counts& counts);

  const std::array<Particle<3>, trace_vertices>& particles() const { return particles_; }
  /// The chain from a vertex to its neighbour k.
  Chain chain(std::size_t vertex, std::size_t k) const;

 private:
  /// The place of an edge among the chains, seen from either end.
  static std::size_t place(std::size_t vertex, std::size_t k) {
    return k * trace_vertices + std::min(vertex, trace_neighbour(vertex, k));
  }

  const Snapshot<3>* snapshot_;
  std::uint64_t epoch_;  ///< of the snapshot, when the body was registered
  std::array<Particle<3>, trace_vertices> particles_;
  /// From the lower vertex of each edge, at its place; half of the places are used
  std::vector<Chain> chains_;
  std::vector<Cell> visited_;        // scratch space of move()
  std::vector<Half_facet> crossed_;  // the same
};

/// The vertices and edges of a body of a trace.
Body_soup<3> trace_body_soup(Trace_positions positions);

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_TRACE_BODY_H
