// SPDX-License-Identifier: LGPL-3.0-or-later
// What a method of figure 8 is: it is built once for a world, and replays a recorded motion by its own answers.
//
// Rule of the replay (docs/formats.md, trace files): per step, per body, per vertex in order, the segment [from, target];
// p = from where it hits a wall, else the target; the segments [p, q_k] to the current positions of the three joined
// vertices. If none of the four hits, the vertex moves to its target, else it stays.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "world.h"

namespace cellwalk::figure_8 {

inline constexpr std::size_t body_vertices = 8;  ///< a body is a hexahedron; v is joined to v^1, v^2, v^4
inline constexpr std::size_t body_edges = 3;     ///< of each vertex

/// Bits of an answer. Bit 0: [from, target] hits a wall. Bits 1 to 3: [p, q_k]. Bits 4 to 6: the triangle
/// (from, target, q_k).
inline constexpr unsigned segment_bits = 0x0f, triangle_bits = 0x70;

/// A recorded motion. The spans belong to the record.
struct Motion {
  std::size_t bodies = 0, steps = 0;
  std::span<const Point<3>> initial;      ///< per body, per vertex
  std::span<const Point<3>> targets;      ///< per step, per body, per vertex
  std::span<const std::uint8_t> answers;  ///< exact, in the order of targets
  std::size_t moves() const { return targets.size(); }
};

/// What a replay did. The same on every machine, but for Embree, whose arithmetic follows the processor.
struct Counts {
  std::uint64_t boxes = 0;           ///< box queries of a hierarchy
  std::uint64_t segments = 0;        ///< rays cast and segments asked of a hierarchy, with or without packets
  std::uint64_t triangle_tests = 0;  ///< a segment or a triangle against a wall triangle, where the peer tells
  std::uint64_t walks = 0;           ///< walks of a particle, temporary ones included
  std::uint64_t crossings = 0;       ///< facets crossed by walks
  std::uint64_t fallbacks = 0;       ///< signs that needed exact arithmetic
  std::uint64_t certified = 0;       ///< moves of vertices free by a proof for their whole body
};

/// Adds to counts, or does nothing at all, so that the timed code carries no counters.
template <bool counting>
struct Counter {
  Counts counts;
  void boxes(std::uint64_t n = 1) {
    if constexpr (counting) counts.boxes += n;
  }
  void segments(std::uint64_t n = 1) {
    if constexpr (counting) counts.segments += n;
  }
  void triangle_tests(std::uint64_t n = 1) {
    if constexpr (counting) counts.triangle_tests += n;
  }
  void walks(std::uint64_t n = 1) {
    if constexpr (counting) counts.walks += n;
  }
  void crossings(std::uint64_t n = 1) {
    if constexpr (counting) counts.crossings += n;
  }
  void certified(std::uint64_t n = 1) {
    if constexpr (counting) counts.certified += n;
  }
};

/// What a peer cost to build.
struct Build {
  double milliseconds = 0;
  std::size_t bytes = 0;     ///< held after the build; 0 where the peer holds nothing of its own
  const char* per = "wall";  ///< what the bytes grow with: "wall" (triangle) or "cell"
};

/// A method of the figure.
class Peer {
 public:
  virtual ~Peer() = default;
  /// Its name in tables: lower case and underscores.
  virtual std::string name() const = 0;
  /// Which bits of the answers it gives.
  virtual unsigned answer_bits() const = 0;
  /// True if its answers and counts are the same on every machine.
  virtual bool is_reproducible() const { return true; }
  /// Finds where the bodies of a motion start. Not a part of the replay, as the recorder hands the cells over too.
  virtual void prepare(const Motion& motion) = 0;
  /// Replays the motion by its own answers and writes them, in the order of motion.targets. Peers without bits 0 to 3
  /// move as the recorded answers say. State of bodies from earlier replays is dropped.
  /// \pre prepare(motion) was called last with the same motion
  virtual void replay(const Motion& motion, std::span<std::uint8_t> answers) = 0;
  /// Replays once more and counts. Slower.
  virtual Counts count(const Motion& motion, std::span<std::uint8_t> answers) = 0;

  Build build;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// Builds all methods of a family for a world, which must outlive them.
using Make_peers = void (*)(const World& world, Peers& peers);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H
