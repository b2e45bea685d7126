// SPDX-License-Identifier: LGPL-3.0-or-later
// The replay of a body trace: its bodies move to its targets by the answers of this library. The rule:
// docs/formats.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_BODY_REPLAY_H
#define CELLWALK_INTERNAL_SIMULATION_BODY_REPLAY_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/body_trace.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// Steps by the rule of a trace: what is blocked stays. They report what blocks.
/// \pre three_segments or triangle: with the latter, swept triangles are answered too
Body_options body_trace_options(Sweep sweep, const Body_trace& trace);

/// The number of edges of each vertex of a body.
/// \param number of the body in its trace
/// \throw Error(input) naming a vertex with more than 64, to whose moves Step_rule::reject_at_target has no
///        answer
std::vector<std::uint32_t> answerable_degrees(const Traced_body& body, std::size_t number);

/// Appends the answers to the moves of one body in one step.
/// \param degrees the number of edges of each vertex
/// \pre what blocks was reported, vertex by vertex
void append_body_answers(std::span<const std::uint32_t> degrees, std::span<const Rejected_move<3>> blocked,
                         Sweep sweep, std::vector<std::uint8_t>& answers);

/// The bodies of a trace in motion, with their radii, without their faces, which the rule leaves alone.
/// Refers to the snapshot, the locator and the trace, which must outlive it.
class Body_replay {
 public:
  /// Registers the bodies where they stand before the first step.
  /// \param first_body number of the first one in errors, if the trace is a part of another
  /// \pre the trace is one that io::read_trace accepts
  /// \throw Error(outside) naming the body, and its vertex or edge; Error(input) naming a vertex with more
  ///        than 64 edges; Error(usage) for Sweep::faces
  Body_replay(const Snapshot<3>& snapshot, const Locator<3>& locator, const Body_trace& trace,
              const Body_options& options, std::size_t first_body = 0);

  /// Puts all bodies where they stand before the next step: by a step, which keeps what is known of walls
  /// nearby; anew where walls are in its way. Not timed.
  /// \pre there is one
  /// \throw Error(outside) as the constructor
  void prepare();
  /// Moves all vertices of all bodies, in order, to the targets of the next step. This is the timed part of a
  /// benchmark.
  /// \pre prepare() was called
  void step();
  /// Appends the answers of the step just done. Not timed.
  void note_answers();

  std::uint32_t steps_done() const { return steps_done_; }
  /// Answers so far, as in the trace; with Sweep::three_segments bit 1 is clear.
  std::span<const std::uint8_t> answers() const { return answers_; }
  std::span<const Body<3>> bodies() const { return bodies_; }
  const Body_counts& counts() const { return counts_; }
  /// How often prepare() had to register a body anew.
  std::uint64_t registered_anew() const { return registered_anew_; }

  /// Refreshes all bodies and checks I1 and I2.
  /// \throw Error(other) naming the first vertex or edge that violates them
  void validate();

 private:
  Body<3> registered(std::size_t body, std::size_t step) const;
  std::span<const Point<3>> part(std::span<const Point<3>> of_step, std::size_t body) const;

  const Snapshot<3>* snapshot_;
  const Locator<3>* locator_;
  const Body_trace* trace_;
  Body_options options_;
  std::size_t first_body_;
  std::size_t vertices_ = 0;               ///< of all bodies
  std::vector<std::size_t> first_vertex_;  ///< of each body
  std::vector<std::vector<std::uint32_t>> degrees_;
  std::vector<Body<3>> bodies_;
  std::vector<Step_report<3>> reports_;  ///< of the bodies in this step
  std::vector<std::uint8_t> answers_;
  std::uint32_t steps_done_ = 0;
  std::uint64_t registered_anew_ = 0;
  Body_counts counts_, counts_of_preparing_;
};

/// The number of answer bits that differ from those of the trace, among the bits that the sweep decides. All
/// bits of a missing step count as different.
/// \pre there are not more answers than in the trace
std::uint64_t count_mismatches(const Body_trace& trace, std::span<const std::uint8_t> answers, Sweep sweep);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_BODY_REPLAY_H
