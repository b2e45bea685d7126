// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays count touches as hits: on traces that land on walls, graze their edges and start at them.
#include <gtest/gtest.h>

#include <iostream>

#include "simulation/replayed.h"
#include "simulation/touching_trace.h"

namespace cellwalk {
namespace {

/// What of a trace is hit by touching alone: nothing of it is blocked where touching is free.
struct Touched {
  int ways = 0, edges = 0, triangles = 0, crossings = 0, free = 0, at_start = 0;

  Touched& operator+=(const Touched& other) {
    ways += other.ways;
    edges += other.edges;
    triangles += other.triangles;
    crossings += other.crossings;
    free += other.free;
    at_start += other.at_start;
    return *this;
  }
};

Touched touched_in(const Body_trace& trace, const Snapshot<3>& snapshot) {
  const Locator<3> locator(snapshot);
  const test::Trace_walls walls(*trace.grid);
  Touched touched;
  Edge_counts counts;
  for (const Point<3>& x : trace.before_step(0)) touched.at_start += walls.meet_segment(x, x);
  test::for_each_recorded_move(trace, [&](const test::Recorded_move& move_of) {
    const auto& [step, body, vertex, from, target, q, answers] = move_of;
    const bool is_free = std::ranges::all_of(answers, [](unsigned a) { return a == 0; });
    touched.free += is_free;
    // Where the start is off all walls it has one side, and what it can reach is known without more.
    if (is_free || walls.meet_segment(from, from)) return;
    Particle<3> p = locator.particle_at(from).value();
    if (move_of.is_blocked()) {
      const bool is_crossing = move(snapshot, p, target, counts.walk).contact.has_value();
      ++(is_crossing ? touched.crossings : touched.ways);
      return;
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
      if (!move_of.is_swept(i) || walls.meet_segment(q[i], q[i])) continue;
      const Particle<3> end = locator.particle_at(q[i]).value();
      const auto before = find_any_chain(snapshot, p, end, counts.walk);
      if (before.contact) continue;
      const bool is_crossing =
          sweep_edge(snapshot, p, target, end, before.chain, {}, counts).contact.has_value();
      if (is_crossing)
        ++touched.crossings;
      else if (move_of.is_blocked_at_end(i))
        ++touched.edges;
      else
        ++touched.triangles;
    }
  });
  return touched;
}

TEST(TouchingReplay, CountsTouchesAsHits) {
  Touched touched;
  std::uint64_t moves = 0, in_region = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::Touching_trace_options options;
    options.seed = seed;
    options.lattice = seed % 3 == 0 ? 8 : 4;
    const Body_trace trace = test::touching_trace(options);
    const Environment<3> environment = trace_environment(*trace.grid);
    touched += touched_in(trace, environment.snapshot());
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle})
      for (const bool clearance : {true, false}) {
        Body_options by_rule = body_trace_options(sweep, trace);
        by_rule.clearance = clearance;
        const test::Replayed replayed = test::replayed(environment.snapshot(), trace, by_rule, true);
        EXPECT_EQ(replayed.mismatches, 0u)
            << "seed " << seed << (sweep == Sweep::triangle ? ", triangle" : ", three segments")
            << (clearance ? ", regions" : "");
        EXPECT_EQ(replayed.registered_anew, 0u);
        moves += trace.moves();
        in_region += replayed.counts.in_region;
      }
  }
  EXPECT_EQ(moves, 12u * 4 * 12 * 60 * 8);
  EXPECT_GT(touched.at_start, 50);
  EXPECT_GT(touched.ways, 500);
  EXPECT_GT(touched.edges, 50);
  EXPECT_GT(touched.triangles, 20);
  EXPECT_GT(touched.crossings, 500);
  EXPECT_GT(touched.free, 2000);
  EXPECT_GT(in_region, 100u);
  std::cout << touched.at_start << " vertices at walls at the start; hit by touching alone: " << touched.ways
            << " ways, " << touched.edges << " edges, " << touched.triangles << " triangles; "
            << touched.crossings << " crossings, " << touched.free << " moves free, " << in_region << " of "
            << moves << " in a region\n";
}

/// One cell, one body: a vertex that ends on a wall hits it, and touches nothing a step before.
TEST(TouchingReplay, AVertexThatEndsOnAWallHitsIt) {
  Body_trace trace;
  trace.touch_blocks = true;
  trace.grid = {{1, 1, 1}, {}};
  trace.bodies = {test::hexahedron()};
  Random random(1);
  const test::Corners start = test::box({0.5, 0.5, 0.5}, 0.5, 0, random);
  trace.before.assign(start.begin(), start.end());
  const Environment<3> environment = trace_environment(*trace.grid);
  const Locator<3> locator(environment.snapshot());
  test::Corners near = start, on = start;
  near[6] = {0.25, 0.875, 0.75};
  on[6] = {0.25, 1, 0.75};
  Target_recorder recorder(environment.snapshot(), locator, trace);
  recorder.step(near);
  recorder.step(on);
  std::vector<std::uint8_t> expected(2 * 8 * 4);
  std::ranges::copy(std::array{body_trace_blocked, body_trace_swept, body_trace_swept, body_trace_swept},
                    expected.begin() + (8 + 6) * 4);
  EXPECT_EQ(recorder.trace().answers, expected);
  EXPECT_EQ(recorder.bodies()[0].positions()[6], near[6]);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle})
    for (const bool clearance : {true, false}) {
      Body_options options = body_trace_options(sweep, trace);
      options.clearance = clearance;
      EXPECT_EQ(test::replayed(environment.snapshot(), recorder.trace(), options).mismatches, 0u);
      Body<3> body(environment.snapshot(), locator, {{near.begin(), near.end()}, trace.bodies[0].edges, {}});
      Step_report<3> report;
      Body_counts counts;
      body.step(on, options, report, counts);
      ASSERT_EQ(report.blocked.size(), 1u);
      EXPECT_EQ(report.blocked[0].contact.value().time, 1);
      EXPECT_EQ(report.blocked[0].contact->normal, (Vector<3>{0, -1, 0}));
    }
}

}  // namespace
}  // namespace cellwalk
