// SPDX-License-Identifier: LGPL-3.0-or-later
// Records the motion of the bodies of a world, whatever moves them, with the exact answers of walls. The rule
// of the answers: docs/formats.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_BODY_TRACE_RECORDER_H
#define CELLWALK_INTERNAL_SIMULATION_BODY_TRACE_RECORDER_H

#include <cellwalk/internal/records/body_trace.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// Records where the bodies of a world stand before each step, where they are to go, and what walls answer to
/// that. It changes nothing in the world: copies of the bodies are asked. Refers to the world, which must
/// outlive it.
class Body_trace_recorder {
 public:
  /// Starts with where the bodies stand now.
  /// \throw Error(input) naming the body of which a vertex has more than 64 edges
  explicit Body_trace_recorder(const World<3>& world);
  /// Goes on with the trace of a world that was saved where this one stands.
  /// \pre the trace has the steps, positions, targets and answers of a recorder of that world; its bodies are
  ///        found
  Body_trace_recorder(const World<3>& world, Body_trace trace);

  /// Records the step that the world has just made: to be called after each.
  /// \throw Error(usage) if the environment was edited since the world was made
  /// Cost: a copy of each body, and its step by the complete sweep.
  void record_step();

  /// The steps so far: it may be replayed or written at any time.
  const Body_trace& trace() const { return trace_; }

 private:
  void take_bodies();
  void note_positions();

  const World<3>& world_;
  Body_trace trace_;
  std::vector<std::vector<std::uint32_t>> degrees_;  ///< of the vertices of each body
  std::vector<Body<3>> before_;                      ///< the bodies as they were before the step
  Step_report<3> report_;                            ///< of one body in one step
  Body_counts counts_;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_BODY_TRACE_RECORDER_H
