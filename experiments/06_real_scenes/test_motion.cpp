// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "motion.h"

namespace cellwalk::real_scenes {
namespace {

/// A square net of vertices, n by n.
Traced_body net(std::uint32_t n) {
  Traced_body body{n * n, {}, {}};
  for (std::uint32_t v = 0; v < n * n; ++v) {
    if (v % n + 1 < n) body.edges.push_back({v, v + 1});
    if (v + n < n * n) body.edges.push_back({v, v + n});
  }
  std::ranges::sort(body.edges);
  return body;
}

TEST(Motion, GroupsPartTheVertices) {
  const Joints joints = make_joints(net(13));
  std::vector<int> times(joints.vertices());
  for (std::size_t g = 0; g < joints.groups.size(); ++g) {
    EXPECT_LE(joints.groups[g].size(), Joints::group_size);
    for (const std::uint32_t v : joints.groups[g]) {
      ++times[v];
      EXPECT_EQ(joints.group_of[v], g);
    }
  }
  EXPECT_EQ(std::ranges::count(times, 1), 169);
  EXPECT_LT(joints.groups.size(), 169u / 5);
}

TEST(Motion, HullsHoldTheNeighboursOfTheirGroup) {
  const Joints joints = make_joints(net(9));
  for (std::size_t g = 0; g < joints.groups.size(); ++g) {
    std::vector<std::uint32_t> hull;
    for (const std::uint32_t v : joints.groups[g]) {
      hull.push_back(v);
      hull.insert(hull.end(), joints.neighbours[v].begin(), joints.neighbours[v].end());
    }
    std::ranges::sort(hull);
    hull.erase(std::unique(hull.begin(), hull.end()), hull.end());
    EXPECT_TRUE(std::ranges::equal(hull, joints.hulls[g])) << g;
  }
}

TEST(Motion, LeavesOutTheFirstStepsAndReadsAnswers) {
  Body_trace trace;
  trace.bodies.assign(2, {2, {{0, 1}}, {}});
  trace.steps = 2;
  trace.before.assign(3 * 4, {0, 0, 0});
  for (double x : {9.0, 9.0, 9.0, 9.0, 1.0, 0.0, 3.0, 2.0}) trace.targets.push_back({0, -x, 0});
  trace.answers.assign(2 * 8, 0);
  trace.answers[8 + 0] = body_trace_blocked;                     // the way of the first vertex
  trace.answers[8 + 3] = body_trace_blocked | body_trace_swept;  // the edge of the second
  trace.answers[8 + 5] = body_trace_swept;                       // passes around a wall: free
  const Motion motion = make_motion(trace, 1);
  EXPECT_EQ(motion.trace.steps, 1u);
  EXPECT_EQ(motion.blocked, (std::vector<std::uint8_t>{1, 1, 0, 0}));
  EXPECT_EQ(motion.step_length, 2);
  EXPECT_EQ(motion.joints[0], motion.joints[1]);
  EXPECT_EQ(motion.first_vertex, (std::vector<std::size_t>{0, 2, 4}));
}

}  // namespace
}  // namespace cellwalk::real_scenes
