// SPDX-License-Identifier: LGPL-3.0-or-later
// A recorded motion (docs/formats.md, traces) as the methods of this experiment need it.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_MOTION_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_MOTION_H

#include <cellwalk/internal/records/body_trace.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cellwalk::real_scenes {

/// Lists of numbers, one after the other.
struct Lists {
  std::vector<std::uint32_t> begin{0}, entries;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {entries.data() + begin[i], entries.data() + begin[i + 1]};
  }
  /// Closes the list that entries were appended to.
  void end_list() { begin.push_back(static_cast<std::uint32_t>(entries.size())); }
};

/// How the vertices of a body are joined, and a partition of them into groups.
struct Joints {
  Lists neighbours;                     ///< of each vertex, ascending
  Lists groups;                         ///< of at most group_size vertices that edges join
  Lists hulls;                          ///< of each group: its vertices and their neighbours
  std::vector<std::uint32_t> group_of;  ///< of each vertex

  static constexpr std::size_t group_size = 8;

  std::size_t vertices() const { return neighbours.size(); }
};

Joints make_joints(const Traced_body& body);

struct Motion {
  Body_trace trace;
  std::vector<std::size_t> first_vertex;              ///< of each body, and their number
  std::vector<std::shared_ptr<const Joints>> joints;  ///< of each body; equal bodies share them
  std::vector<std::uint8_t> blocked;                  ///< the exact answers: [step][vertex], 1 if it stays
  double radius = 0;  ///< that all edges keep from walls; 0: they may touch them
  /// The median of the distances that vertices that move are asked to move in a step, by their largest
  /// coordinate.
  double step_length = 0;

  std::size_t bodies() const { return joints.size(); }
  std::span<const std::uint8_t> blocked_in_step(std::size_t step) const {
    return std::span(blocked).subspan(step * trace.vertices(), trace.vertices());
  }
};

/// For each vertex of a step, 1 if the answers say that it stays.
/// \param answers of one step, as in the trace
void note_blocked(const Motion& motion, std::span<const std::uint8_t> answers,
                  std::span<std::uint8_t> blocked);

/// \param first_step what comes before is left out
/// \throw Error(input) if edges have different radii
/// \pre first_step < trace.steps, and the trace holds answers
Motion make_motion(Body_trace trace, std::uint32_t first_step);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_MOTION_H
