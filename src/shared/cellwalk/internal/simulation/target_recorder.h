// SPDX-License-Identifier: LGPL-3.0-or-later
// Records bodies that the rule of traces alone moves: to given targets, with the exact answers.
#ifndef CELLWALK_INTERNAL_SIMULATION_TARGET_RECORDER_H
#define CELLWALK_INTERNAL_SIMULATION_TARGET_RECORDER_H

#include <cellwalk/internal/simulation/body_replay.h>

#include <span>

namespace cellwalk {

/// Records a trace step by step. Refers to the snapshot and the locator, which must outlive it.
class Target_recorder {
 public:
  /// \param start a trace without steps: its bodies, where they start, and how touches count
  /// \throw Error(outside) naming the body that does not start in free space; Error(input) naming the one
  ///        that has all its vertices in one place, or touches a wall where touches block
  Target_recorder(const Snapshot<3>& snapshot, const Locator<3>& locator, Body_trace start);
  Target_recorder(const Target_recorder&) = delete;
  Target_recorder& operator=(const Target_recorder&) = delete;

  /// Moves all vertices of all bodies, in order.
  /// \pre one finite target for each vertex
  /// Cost: that of Body::step.
  void step(std::span<const Point<3>> targets);

  const Body_trace& trace() const { return trace_; }
  std::span<const Body<3>> bodies() const { return replay_.bodies(); }

 private:
  Body_trace trace_;
  Body_replay replay_;  ///< of trace_, to which each step adds one
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TARGET_RECORDER_H
