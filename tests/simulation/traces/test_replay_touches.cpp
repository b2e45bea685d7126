// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays count touches as hits: on traces that land on walls, graze their edges and start at them.
#include <cellwalk/internal/simulation/replay.h>

#include <gtest/gtest.h>

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

Touched touched_in(const Trace& trace, const Environment<3>& environment) {
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  const test::Trace_walls walls(trace);
  Touched touched;
  Edge_counts counts;
  for (const Point<3>& x : trace.start_positions) touched.at_start += walls.meet_segment(x, x);
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    const unsigned answer = trace.answers[i];
    touched.free += answer == 0;
    // Where the start is off all walls it has one side, and what it can reach is known without more.
    if (answer == 0 || walls.meet_segment(from, from)) return;
    Particle<3> p = locator.particle_at(from).value();
    if ((answer & trace_segment_bit) != 0) {
      const bool is_blocked = move(snapshot, p, target, counts.walk).contact.has_value();
      ++(is_blocked ? touched.crossings : touched.ways);
      return;
    }
    for (std::size_t k = 0; k < trace_edges; ++k) {
      if ((answer >> (4 + k) & 1) == 0 || walls.meet_segment(q[k], q[k])) continue;
      const Particle<3> end = locator.particle_at(q[k]).value();
      const auto before = find_any_chain(snapshot, p, end, counts.walk);
      if (before.contact) continue;
      const bool is_blocked =
          sweep_edge(snapshot, p, target, end, before.chain, {}, counts).contact.has_value();
      if (is_blocked)
        ++touched.crossings;
      else if ((answer >> (1 + k) & 1) != 0)
        ++touched.edges;
      else
        ++touched.triangles;
    }
  });
  return touched;
}

TEST(Replay, CountsTouchesAsHits) {
  Touched touched;
  std::uint64_t moves = 0, in_region = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::Touching_trace_options options;
    options.seed = seed;
    options.lattice = seed % 3 == 0 ? 8 : 4;
    const Trace trace = test::touching_trace(options);
    const Environment<3> environment = trace_environment(trace);
    const Locator<3> locator(environment.snapshot());
    touched += touched_in(trace, environment);
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle})
      for (const bool clearance : {true, false}) {
        Replay replay(environment.snapshot(), locator, trace, {sweep, clearance});
        replay.run();
        EXPECT_EQ(count_mismatches(trace, replay.answers(), sweep), 0u)
            << "seed " << seed << (sweep == Sweep::triangle ? ", triangle" : ", three segments")
            << (clearance ? ", regions" : "");
        EXPECT_EQ(replay.contacts().size(), replay.counts().body.contacts);
        EXPECT_NO_THROW(replay.validate());
        moves += trace.moves();
        in_region += replay.counts().body.in_region;
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
TEST(Replay, AVertexThatEndsOnAWallHitsIt) {
  Trace trace;
  trace.nx = trace.ny = trace.nz = trace.bodies = 1;
  trace.steps = 2;
  for (std::size_t v = 0; v < trace_vertices; ++v) {
    Point<3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = (v >> k & 1) == 0 ? 0.25 : 0.75;
    trace.start_positions.push_back(x);
  }
  trace.targets = trace.start_positions;
  trace.targets.insert(trace.targets.end(), trace.start_positions.begin(), trace.start_positions.end());
  trace.targets[6] = {0.25, 0.875, 0.75};
  trace.targets[8 + 6] = {0.25, 1, 0.75};
  trace.answers.assign(16, 0);
  trace.answers[8 + 6] = trace_segment_bit | trace_triangle_bits;
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle})
    for (const bool clearance : {true, false}) {
      Replay replay(environment.snapshot(), locator, trace, {sweep, clearance});
      replay.run();
      EXPECT_EQ(count_mismatches(trace, replay.answers(), sweep), 0u);
      EXPECT_EQ(replay.bodies()[0].positions()[6], trace.targets[6]);
      ASSERT_EQ(replay.contacts().size(), 1u);
      EXPECT_EQ(replay.contacts()[0].contact.time, 1);
      EXPECT_EQ(replay.contacts()[0].contact.normal, (Vector<3>{0, -1, 0}));
    }
}

}  // namespace
}  // namespace cellwalk
