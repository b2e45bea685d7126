// SPDX-License-Identifier: LGPL-3.0-or-later
// The replay of a trace: its bodies are moved to its targets by the program's own answers. The rule: docs/formats.md.
#ifndef CELLWALK_SIMULATION_REPLAY_H
#define CELLWALK_SIMULATION_REPLAY_H

#include <cellwalk/simulation/trace_body.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// A move that met a wall. With Sweep::triangle it may be one after which the vertex moved all the same, since its edges went
/// round an obstacle.
struct Replay_contact {
  std::uint32_t step = 0, body = 0, vertex = 0;
  Contact<3> contact;
};

/// The bodies of a trace on their way. Refers to the snapshot and the trace, which must outlive it.
class Replay {
 public:
  /// Registers the bodies where they start.
  /// \pre sweep is three_segments or triangle; the trace is one that io::read_trace accepts
  /// \throw Error(outside) naming the body, and its vertex or edge; Error(usage) for Sweep::faces: the bodies of a trace have
  ///        no faces
  Replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Trace& trace, Sweep sweep);

  /// Moves all vertices of all bodies, in order, to the targets of the next step. \pre there is one
  void step();
  /// All steps that are left. This is what is timed.
  void run();

  std::uint32_t steps_done() const { return steps_done_; }
  /// Answers so far, [step][body][vertex]: bits 0 to 3, and with Sweep::triangle bits 4 to 6.
  std::span<const std::uint8_t> answers() const { return answers_; }
  /// In the order met.
  std::span<const Replay_contact> contacts() const { return contacts_; }
  std::span<const Trace_body> bodies() const { return bodies_; }
  const Trace_counts& counts() const { return counts_; }

 private:
  const Trace* trace_;
  Sweep sweep_;
  std::vector<Trace_body> bodies_;
  std::vector<std::uint8_t> answers_;
  std::vector<Replay_contact> contacts_;
  std::uint32_t steps_done_ = 0;
  Trace_counts counts_;
};

/// Bits of answers that differ from those of the trace, among the bits that the sweep decides. A step that is not done counts
/// with all of them. \pre answers are no longer than those of the trace
std::uint64_t count_mismatches(const Trace& trace, std::span<const std::uint8_t> answers, Sweep sweep);

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_REPLAY_H
