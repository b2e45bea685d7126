// SPDX-License-Identifier: LGPL-3.0-or-later
// Records traces: moves bodies to given targets by the rule of traces, and stores the exact answers.
#ifndef CELLWALK_SIMULATION_TRACE_RECORDER_H
#define CELLWALK_SIMULATION_TRACE_RECORDER_H

#include <cellwalk/simulation/trace_body.h>

#include <span>
#include <vector>

namespace cellwalk {

/// Records a trace step by step. Refers to the snapshot, which must outlive it.
///
/// In a trace a touch counts as a hit, while here touching is free (see Touch). To make both rules agree,
/// motions that touch a wall without hitting it are refused, and so are edges that touch a wall at the start.
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
  /// \throw Error(input) naming the step, body and vertex of a move that touches a wall; then its step is not
  ///        recorded, and the recorder must not be used any more
  /// Cost: some ten times that of the replay, since touches are detected.
  void step(std::span<const Point<3>> targets);

  const Trace& trace() const { return trace_; }
  std::span<const Trace_body> bodies() const { return bodies_; }
  const Trace_counts& counts() const { return counts_; }

 private:
  void check_start(std::size_t body) const;
  bool touches(const Trace_body& body, std::size_t vertex, const Point<3>& target) const;

  const Snapshot<3>* snapshot_;
  Trace trace_;
  std::vector<Trace_body> bodies_;
  Trace_counts counts_;
};

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_TRACE_RECORDER_H
