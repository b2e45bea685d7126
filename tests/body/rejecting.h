// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps by the rule of traces.
#ifndef CELLWALK_TESTS_BODY_REJECTING_H
#define CELLWALK_TESTS_BODY_REJECTING_H

#include <cellwalk/body/body.h>

#include <span>
#include <vector>

namespace cellwalk::test {

inline Body_options rejecting(Sweep sweep, Touch touch, bool clearance) {
  Body_options options;
  options.sweep.sweep = sweep;
  options.sweep.touch = touch;
  options.clearance = clearance;
  return options;
}

/// What blocks, vertex by vertex.
template <int D>
std::vector<Blocked_move<D>> reject(Body<D>& body, std::span<const Point<D>> targets,
                                    const Body_options& options, Body_counts& counts) {
  std::vector<Blocked_move<D>> blocked;
  body.step_or_stay(targets, options, blocked, counts);
  return blocked;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_REJECTING_H
