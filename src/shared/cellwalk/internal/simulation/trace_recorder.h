// SPDX-License-Identifier: LGPL-3.0-or-later
// Records traces in a grid: moves bodies to given targets by their rule, and stores the exact answers.
#ifndef CELLWALK_INTERNAL_SIMULATION_TRACE_RECORDER_H
#define CELLWALK_INTERNAL_SIMULATION_TRACE_RECORDER_H

#include <cellwalk/internal/simulation/trace_rule.h>
#include <cellwalk/walk/locate.h>

#include <span>
#include <vector>

namespace cellwalk {

/// Records a trace step by step. Refers to the snapshot, which must outlive it.
class Trace_recorder {
 public:
  /// \param snapshot the environment of the trace
  /// \param start a trace with its numbers of cells, its obstacles and the start positions of its bodies;
  ///        without steps
  /// \throw Error(outside) naming the body that does not start in free space; Error(input) naming the one
  ///        that touches a wall, or has all its vertices in one place
  Trace_recorder(const Snapshot<3>& snapshot, const Locator<3>& locator, Trace start);

  /// Moves all vertices of all bodies, in order.
  /// \pre one finite target for each vertex, [body][vertex]
  /// Cost: that of Body::step.
  void step(std::span<const Point<3>> targets);

  const Trace& trace() const { return trace_; }
  std::span<const Body<3>> bodies() const { return bodies_; }
  const Body_counts& counts() const { return counts_; }

 private:
  Trace trace_;
  std::vector<Body<3>> bodies_;
  Step_report<3> report_;  ///< of one body in one step
  Body_counts counts_;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TRACE_RECORDER_H
