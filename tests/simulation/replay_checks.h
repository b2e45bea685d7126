// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELLWALK_TESTS_SIMULATION_REPLAY_CHECKS_H
#define CELLWALK_TESTS_SIMULATION_REPLAY_CHECKS_H

#include <cellwalk/simulation/replay.h>

#include <gtest/gtest.h>

namespace cellwalk::test {

/// Every vertex lies in its cell (I1), every edge has a chain from either end (I2).
inline void expect_valid(const Snapshot<3>& snapshot, const Replay& replay) {
  Walk_counts counts;
  for (const Trace_body& body : replay.bodies())
    for (std::size_t v = 0; v < trace_vertices; ++v) {
      const Particle<3>& p = body.particles()[v];
      EXPECT_TRUE(in_closure(snapshot, p.cell, p.position));
      for (std::size_t k = 0; k < trace_edges; ++k)
        EXPECT_TRUE(is_chain(snapshot, p, body.particles()[trace_neighbour(v, k)], body.chain(v, k), counts));
    }
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_REPLAY_CHECKS_H
