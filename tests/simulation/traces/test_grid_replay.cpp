// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces that hold their grid, and in which touches block.
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "simulation/random_trace.h"
#include "simulation/replayed.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

using test::Recorded_move;

/// Boxes almost as large as the gaps between obstacles, in long steps: all kinds of answers occur.
const Body_trace& crowded() {
  static const Body_trace trace = test::random_trace({});
  return trace;
}

TEST(GridReplay, RecordedAnswersAreThoseOfBruteForce) {
  const test::Trace_walls walls(*crowded().grid);
  int free = 0, blocked = 0, edges = 0, swept = 0, rounds = 0, moved_round = 0;
  test::for_each_recorded_move(crowded(), [&](const Recorded_move& move) {
    ASSERT_TRUE(std::ranges::equal(
        move.answers, test::answers_where_touches_block(walls, move.from, move.target, move.neighbours)));
    bool goes_round = false;
    for (std::size_t i = 0; i < move.neighbours.size() && !move.is_blocked(); ++i) {
      edges += move.is_blocked_at_end(i);
      swept += move.is_swept(i);
      rounds += move.is_swept(i) && !move.is_blocked_at_end(i);
      goes_round |= move.is_swept(i);
    }
    blocked += move.is_blocked();
    moved_round += goes_round && !move.stays();
    free += !goes_round && !move.stays();
  });
  EXPECT_GT(free, 10000);
  EXPECT_GT(blocked, 2000);
  EXPECT_GT(edges, 300);
  EXPECT_GT(swept, 300);
  EXPECT_GT(rounds, 5);
  EXPECT_GT(moved_round, 2);
}

/// With other walls brute force gives other answers: it can tell.
TEST(GridReplay, BruteForceSeesFalseAnswers) {
  Traced_grid grid = *crowded().grid;
  grid.solid.resize(grid.solid.size() / 2);
  const test::Trace_walls fewer_walls(grid);
  int different = 0;
  test::for_each_recorded_move(crowded(), [&](const Recorded_move& move) {
    if (move.stays())
      different += !std::ranges::equal(
          move.answers,
          test::answers_where_touches_block(fewer_walls, move.from, move.target, move.neighbours));
  });
  EXPECT_GT(different, 100);
}

TEST(GridReplay, GivesTheRecordedAnswers) {
  const Environment<3> environment = trace_environment(*crowded().grid);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const test::Replayed replayed =
        test::replayed(environment.snapshot(), crowded(), body_trace_options(sweep, crowded()), true);
    EXPECT_EQ(replayed.mismatches, 0u);
    EXPECT_EQ(replayed.registered_anew, 0u);
    EXPECT_EQ(replayed.counts.moves, crowded().moves());
    EXPECT_GT(replayed.counts.in_region, crowded().moves() / 2);
  }
}

/// Cells that are no cubes cost the same: without regions, the same walks, crossings and certificates.
/// Regions have oblique sides there, and hold nearly as much.
TEST(GridReplay, ShearedCellsAreLikeCubes) {
  const Environment<3> cubes = trace_environment(*crowded().grid),
                       leaning = trace_environment(*crowded().grid, sheared<3>());
  const Body_trace moved = mapped(crowded(), sheared<3>());
  EXPECT_NE(moved.before[0], crowded().before[0]);
  EXPECT_EQ(mapped(crowded(), {}).targets, crowded().targets);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const auto counts_of = [sweep](const Environment<3>& environment, const Body_trace& trace,
                                   bool clearance) {
      Body_options options = body_trace_options(sweep, trace);
      options.clearance = clearance;
      const test::Replayed replayed = test::replayed(environment.snapshot(), trace, options);
      EXPECT_EQ(replayed.mismatches, 0u);
      return replayed.counts;
    };
    const Edge_counts a = counts_of(cubes, crowded(), false).edges,
                      b = counts_of(leaning, moved, false).edges;
    EXPECT_EQ(a.event_sweeps, b.event_sweeps);
    // Single precision leaves other signs in doubt.
    const auto expect_near = [](std::uint64_t x, std::uint64_t y, double part) {
      EXPECT_NEAR(static_cast<double>(x), static_cast<double>(y), part * static_cast<double>(x));
    };
    expect_near(a.edges, b.edges, 1e-3);
    expect_near(a.same_cell, b.same_cell, 1e-3);
    expect_near(a.same_chain, b.same_chain, 1e-3);
    expect_near(a.walk.walks, b.walk.walks, 5e-3);
    expect_near(a.walk.crossings, b.walk.crossings, 6e-3);
    EXPECT_GT(static_cast<double>(counts_of(leaning, moved, true).in_region),
              0.9 * static_cast<double>(counts_of(cubes, crowded(), true).in_region));
  }
}

using Move_number = std::array<std::size_t, 3>;  ///< step, body, vertex

/// Moves the bodies of a trace by steps of any kind: its contacts, by the moves that meet them.
std::map<Move_number, Contact<3>> contacts_of(const Body_trace& trace, const Snapshot<3>& snapshot,
                                              const Body_options& options, Body_counts& counts) {
  const Locator<3> locator(snapshot);
  Body_replay start(snapshot, locator, trace, body_trace_options(Sweep::triangle, trace));
  std::map<Move_number, Contact<3>> contacts;
  std::vector<Body<3>> bodies(start.bodies().begin(), start.bodies().end());
  for (std::size_t step = 0; step < trace.steps; ++step)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      EXPECT_TRUE(std::ranges::equal(bodies[b].positions(), trace.before_step(step).subspan(8 * b, 8)));
      Step_report<3> report;
      bodies[b].step(trace.targets_of_step(step).subspan(8 * b, 8), options, report, counts);
      for (const Contact<3>& met : report.contacts)
        EXPECT_TRUE(contacts.emplace(Move_number{step, b, met.vertex}, met).second);
      for (const Rejected_move<3>& blocked : report.blocked) {
        if (!blocked.contact) continue;
        EXPECT_TRUE(contacts.emplace(Move_number{step, b, blocked.vertex}, *blocked.contact).second);
      }
    }
  return contacts;
}

/// Bodies that report contacts have one for each vertex that stays, at the time at which brute force finds
/// the vertex or the first of its edges that are in the way at a wall.
TEST(GridReplay, BodiesReportContactsOfTheSameMoves) {
  const Environment<3> environment = trace_environment(*crowded().grid);
  Body_options options = body_trace_options(Sweep::triangle, crowded());
  options.reports_blocked = false;
  Body_counts counts;
  const auto contacts = contacts_of(crowded(), environment.snapshot(), options, counts);
  const test::Trace_walls walls(*crowded().grid);
  int of_vertices = 0, of_edges = 0, of_edges_before = 0;
  test::for_each_recorded_move(crowded(), [&](const Recorded_move& move) {
    const auto found = contacts.find({move.step, move.body, move.vertex});
    ASSERT_EQ(found != contacts.end(), move.stays());
    if (!move.stays()) return;
    const Contact<3>& contact = found->second;
    std::optional<double> first, of_any_edge;
    for (std::size_t i = 0; i < move.neighbours.size(); ++i)
      if (const auto time = walls.meet_triangle(move.from, move.target, move.neighbours[i])) {
        of_any_edge = std::min(*time, of_any_edge.value_or(1));
        if (move.is_blocked_at_end(i)) first = std::min(*time, first.value_or(1));
      }
    if (move.is_blocked()) first = walls.meet_triangle(move.from, move.target, move.from);  // its way alone
    ASSERT_TRUE(first);
    if (move.is_blocked() && contact.body == Body_feature::edge) {
      // It met the wall before, in a place where the edge does not pass when the vertex is stopped.
      EXPECT_LE(contact.time, *first);
      EXPECT_GE(contact.time, *of_any_edge - 0x1p-50);
      ++of_edges_before;
    } else {
      EXPECT_NEAR(contact.time, *first, 0x1p-50);
    }
    EXPECT_NEAR(length(contact.normal), 1, 0x1p-40);
    ++(contact.body == Body_feature::vertex ? of_vertices : of_edges);
  });
  EXPECT_GT(of_vertices, 2000);
  EXPECT_GT(of_edges, 200);
  std::cout << of_vertices << " contacts of vertices, " << of_edges << " of edges, " << of_edges_before
            << " of these before that of the vertex\n";
}

/// What blocks names the wall that is in the way of a vertex, or of an edge at its end.
TEST(GridReplay, NamesWalls) {
  const Environment<3> environment = trace_environment(*crowded().grid);
  const Snapshot<3>& snapshot = environment.snapshot();
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    Body_counts counts;
    const auto contacts = contacts_of(crowded(), snapshot, body_trace_options(sweep, crowded()), counts);
    EXPECT_EQ(contacts.size(), counts.contacts);
    int of_vertices = 0, of_edges = 0;
    test::for_each_recorded_move(crowded(), [&](const Recorded_move& move) {
      const auto found = contacts.find({move.step, move.body, move.vertex});
      ASSERT_EQ(found != contacts.end(), move.stays());
      if (!move.stays()) return;
      const Contact<3>& contact = found->second;
      EXPECT_EQ(contact.body, move.is_blocked() ? Body_feature::vertex : Body_feature::edge);
      EXPECT_TRUE(snapshot.is_impassable(contact.facet));
      EXPECT_NEAR(length(contact.normal), 1, 0x1p-40);
      // The point lies on the way of the vertex, or on the edge from its target.
      double off = 1;
      for (const Point<3>& end : move.neighbours) {
        const Point<3>&a = move.is_blocked() ? move.from : move.target,
              &b = move.is_blocked() ? move.target : end;
        off = std::min(off, length(contact.point - (a + contact.time * (b - a))));
      }
      EXPECT_LT(off, 1e-12);
      ++(move.is_blocked() ? of_vertices : of_edges);
    });
    EXPECT_GT(of_vertices, 2000);
    EXPECT_GT(of_edges, 200);
  }
}

/// Where nothing touches a wall, three segments whose first contact decides move bodies as the trace says.
TEST(GridReplay, SweptSegmentsThatRejectGoTheSameWay) {
  const Environment<3> environment = trace_environment(*crowded().grid);
  Body_options options;
  options.sweep.sweep = Sweep::three_segments;
  options.rule = Step_rule::reject;
  Body_counts counts;
  const auto contacts = contacts_of(crowded(), environment.snapshot(), options, counts);
  EXPECT_EQ(contacts.size(), counts.held);
  EXPECT_GT(counts.held, 2000u);
  EXPECT_EQ(counts.stop_tries, 0u);
}

/// An edge that goes round an obstacle is in the way where what it sweeps counts, and not where its target
/// does.
TEST(GridReplay, SweptTrianglesRejectWhatGoesRound) {
  const Environment<3> environment = trace_environment(*crowded().grid);
  const Locator<3> locator(environment.snapshot());
  Body_options rejecting;
  rejecting.rule = Step_rule::reject;
  int rejected = 0;
  test::for_each_recorded_move(crowded(), [&](const Recorded_move& move) {
    if (move.stays() || std::ranges::count(move.answers, 0) == 4) return;
    const std::size_t first = 8 * move.body;
    const auto before = crowded().before_step(move.step).subspan(first, 8);
    Body<3> body(environment.snapshot(), locator,
                 {{before.begin(), before.end()}, crowded().bodies[move.body].edges, {}});
    // Vertices before this one move as the trace has it.
    std::vector<Point<3>> targets(before.begin(), before.end());
    std::ranges::copy(crowded().targets_of_step(move.step).subspan(first, move.vertex), targets.begin());
    Step_report<3> report;
    Body_counts counts;
    const Body_options options = body_trace_options(Sweep::triangle, crowded());
    body.step(targets, options, report, counts);
    std::ranges::copy(body.positions(), targets.begin());
    ASSERT_EQ(targets[move.vertex], move.from);
    targets[move.vertex] = move.target;
    Body<3> other = body;
    report.clear();
    body.step(targets, options, report, counts);
    EXPECT_EQ(body.positions()[move.vertex], move.target);
    report.clear();
    other.step(targets, rejecting, report, counts);
    EXPECT_EQ(other.positions()[move.vertex], move.from);
    EXPECT_EQ(report.contacts.size(), 1u);
    ++rejected;
  });
  EXPECT_GT(rejected, 2);
}

TEST(TraceEnvironment, HasTheSolidCellsOfTheGrid) {
  const Traced_grid& grid = *crowded().grid;
  ASSERT_GT(grid.solid.size(), 5u);
  for (const Lattice_map<3>& map : {Lattice_map<3>{}, sheared<3>(), rotated<3>()}) {
    const Environment<3> environment = trace_environment(grid, map);
    const Snapshot<3>& snapshot = environment.snapshot();
    ASSERT_EQ(snapshot.cell_count(), grid.cell_count());
    std::vector<std::uint32_t> solid;
    for (std::uint32_t i = 0; i < snapshot.cell_count(); ++i)
      if (snapshot.is_solid(snapshot.cell(i))) solid.push_back(i);
    EXPECT_EQ(solid, grid.solid);
  }
  EXPECT_THROW(trace_environment({{1u << 16, 1u << 16, 1}, {}}), Error);
}

}  // namespace
}  // namespace cellwalk
