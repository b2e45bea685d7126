// SPDX-License-Identifier: LGPL-3.0-or-later
// The replay of a trace in a grid: its bodies move to its targets by the answers of this library. The rule:
// docs/formats.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_REPLAY_H
#define CELLWALK_INTERNAL_SIMULATION_REPLAY_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/trace.h>
#include <cellwalk/kernel/counts.h>
#include <cellwalk/simulation/run_contact.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cellwalk {

/// The counts of a replay. They are machine-independent.
struct Replay_counts {
  std::uint64_t vertex_hits = 0;    ///< moves in which the vertex hits: bit 0
  std::uint64_t edge_hits = 0;      ///< edges that hit at the target: bits 1 to 3
  std::uint64_t triangle_hits = 0;  ///< triangles swept by edges that hit: bits 4 to 6
  std::uint64_t rounds = 0;  ///< edges that passed around an obstacle: the triangle hits, the edge does not
  Body_counts body;          ///< held: moves after which the vertex stays in place

  static constexpr std::array<std::string_view, 4> names{"vertex_hits", "edge_hits", "triangle_hits",
                                                         "rounds"};
};
static_assert(names_all_before<Replay_counts>(offsetof(Replay_counts, body)));

struct Replay_options {
  Sweep sweep = Sweep::triangle;  ///< three_segments or triangle
  bool clearance = true;          ///< see Body_options
};

/// The bodies of a trace in motion. Refers to the snapshot and the trace, which must outlive it.
class Replay {
 public:
  /// Registers the bodies at their start positions.
  /// \param first_body number of the first one in errors, if the trace is a part of another
  /// \pre the trace is one that io::read_trace accepts
  /// \throw Error(outside) naming the body, and its vertex or edge; Error(usage) for Sweep::faces: the bodies
  ///        of a trace have no faces
  Replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace& trace,
         const Replay_options& options, std::size_t first_body = 0);

  /// Moves all vertices of all bodies, in order, to the targets of the next step.
  /// \pre there is one
  void step();
  /// Executes all remaining steps. This is the timed part of a benchmark.
  void run();

  std::uint32_t steps_done() const { return steps_done_; }
  /// Answers so far, [step][body][vertex]: bits 0 to 3, and with Sweep::triangle bits 4 to 6.
  std::span<const std::uint8_t> answers() const {
    return std::span(answers_).first(trace_->index(steps_done_, 0, 0));
  }
  /// The contacts of the vertices that stayed in place, in the order met.
  std::span<const Run_contact<3>> contacts() const { return contacts_; }
  std::span<const Body<3>> bodies() const { return bodies_; }
  const Replay_counts& counts() const { return counts_; }

  /// Refreshes all bodies and checks I1 and I2.
  /// \throw Error(other) naming the first body that violates them
  void validate();

 private:
  void note(std::uint32_t body, const Rejected_move<3>& blocked);

  const Snapshot<3>* snapshot_;
  const Trace* trace_;
  Body_options options_;
  std::vector<Body<3>> bodies_;
  Step_report<3> report_;              ///< of one body in one step
  std::vector<std::uint8_t> answers_;  ///< of all moves; 0 for future ones
  std::vector<Run_contact<3>> contacts_;
  std::uint32_t steps_done_ = 0;
  Replay_counts counts_;
};

/// The number of answer bits that differ from those of the trace, among the bits that the sweep decides. All
/// bits of a missing step count as different.
/// \pre there are not more answers than in the trace
std::uint64_t count_mismatches(const Trace& trace, std::span<const std::uint8_t> answers, Sweep sweep);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_REPLAY_H
