// SPDX-License-Identifier: LGPL-3.0-or-later
// What a method of figure 8 is: it is built once for a world, and replays a recorded motion by its own
// answers.
//
// Rule of the replay (docs/formats.md, trace files): per step, per body, per vertex in order, the segment
// [from, target]; p = from where it hits a wall, else the target; the segments [p, q_k] to the current
// positions of the three joined vertices. If none of the four hits, the vertex moves to its target, else it
// stays.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/peers/measured_build.h"
#include "hexahedra_trace.h"
#include "world.h"

namespace cellwalk::figure_8 {

using experiments::Build;
using experiments::measured_build;

/// Which bits of an answer a method gives: those of the segments, of the triangles, or both.
inline constexpr unsigned segment_bits = trace_segment_bit | trace_edge_bits;
inline constexpr unsigned triangle_bits = trace_triangle_bits;

/// What a replay did. The same on every machine, but for Embree, whose arithmetic follows the processor.
struct Counts {
  std::uint64_t boxes = 0;            ///< box queries of a hierarchy
  std::uint64_t queries = 0;          ///< rays, segments and triangles asked of a hierarchy, packets or not
  std::uint64_t triangle_tests = 0;   ///< of a wall triangle, where the peer lets them be counted
  std::uint64_t walks = 0;            ///< walks of a particle, temporary ones included
  std::uint64_t crossings = 0;        ///< facets crossed by walks
  std::uint64_t signs = 0;            ///< orientations asked of a number policy
  std::uint64_t fallbacks = 0;        ///< of them: exact arithmetic was needed
  std::uint64_t certified_edges = 0;  ///< edges decided by a certificate
  std::uint64_t clear_moves = 0;      ///< moves of vertices free because the whole body is
};

/// Adds to counts, or does nothing at all, so that the timed code carries no counters.
template <bool counting>
struct Counter {
  Counts counts;
  void boxes(std::uint64_t n = 1) {
    if constexpr (counting) counts.boxes += n;
  }
  void queries(std::uint64_t n = 1) {
    if constexpr (counting) counts.queries += n;
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
  void clear_moves(std::uint64_t n = 1) {
    if constexpr (counting) counts.clear_moves += n;
  }
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
  /// Places the bodies where the trace starts, and drops what is remembered of an earlier replay. It is not
  /// timed: the recorder hands the bodies over as they are registered.
  virtual void prepare(const Trace& trace) = 0;
  /// Replays the trace by its own answers and writes them, in the order of trace.targets. Peers without bits
  /// 0 to 3 move as the recorded answers say.
  /// \pre prepare(trace) was called since the last replay
  virtual void replay(const Trace& trace, std::span<std::uint8_t> answers) = 0;
  /// The same, and counts. Slower.
  virtual Counts count(const Trace& trace, std::span<std::uint8_t> answers) = 0;

  Build build;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// Builds all methods of a family for a world, which must outlive them.
using Make_peers = void (*)(const Grid_world& world, Peers& peers);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_PEER_H
