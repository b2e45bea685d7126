// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/body.h>
#include <cellwalk/internal/simulation/replay.h>
#include <cellwalk/internal/simulation/trace_rule.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <iostream>
#include <map>

#include "simulation/random_trace.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

using test::Random_trace_options;

/// Boxes almost as large as the gaps between obstacles, in long steps: all kinds of answers occur.
const Trace& crowded() {
  static const Trace trace = test::random_trace({});
  return trace;
}

struct Answer_counts {
  int segments = 0, edges = 0, triangles = 0, rounds = 0, clear = 0;
  int moved_round = 0;  ///< moves that nothing holds, and with edges that go round an obstacle
};

Answer_counts counted(std::span<const std::uint8_t> answers) {
  Answer_counts counts;
  for (const unsigned a : answers) {
    counts.clear += a == 0;
    counts.segments += (a & 1) != 0;
    if ((a & 1) != 0) continue;
    counts.edges += std::popcount(a & 0x0eu);
    counts.triangles += std::popcount(a & 0x70u);
    counts.rounds += std::popcount((a >> 4) & ~(a >> 1) & 7u);
    counts.moved_round += a != 0 && (a & 0x0eu) == 0;
  }
  return counts;
}

TEST(Replay, RecordedAnswersAreThoseOfBruteForce) {
  const Trace& trace = crowded();
  const test::Trace_walls walls(trace);
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    ASSERT_EQ(int{trace.answers[i]}, int{test::answer(walls, from, target, q)}) << "move " << i;
  });
  const Answer_counts counts = counted(trace.answers);
  EXPECT_GT(counts.clear, 10000);
  EXPECT_GT(counts.segments, 2000);
  EXPECT_GT(counts.edges, 300);
  EXPECT_GT(counts.triangles, 300);
  EXPECT_GT(counts.rounds, 5);
  EXPECT_GT(counts.moved_round, 2);
}

/// With other walls brute force gives other answers: it can tell.
TEST(Replay, BruteForceSeesFalseAnswers) {
  Trace trace = crowded();
  trace.obstacles.resize(trace.obstacles.size() / 2);
  const test::Trace_walls fewer_walls(trace);
  int different = 0;
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    if (trace.answers[i] != 0) different += test::answer(fewer_walls, from, target, q) != trace.answers[i];
  });
  EXPECT_GT(different, 100);
}

TEST(Replay, GivesTheRecordedAnswers) {
  const Trace& trace = crowded();
  const Answer_counts facts = counted(trace.answers);
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    Replay replay(environment.snapshot(), locator, trace, {sweep, true});
    EXPECT_EQ(count_mismatches(trace, replay.answers(), sweep),
              trace.moves() * (sweep == Sweep::triangle ? 7 : 4));
    for (std::uint32_t step = 0; step < trace.steps / 2; ++step) {
      replay.step();
      EXPECT_NO_THROW(replay.validate());
    }
    replay.run();
    EXPECT_NO_THROW(replay.validate());
    EXPECT_EQ(replay.steps_done(), trace.steps);
    EXPECT_EQ(count_mismatches(trace, replay.answers(), sweep), 0u);
    const Replay_counts& counts = replay.counts();
    EXPECT_EQ(counts.body.moves, trace.moves());
    EXPECT_GT(counts.body.in_region, trace.moves() / 2);
    EXPECT_EQ(counts.vertex_hits, static_cast<std::uint64_t>(facts.segments));
    EXPECT_EQ(counts.edge_hits, static_cast<std::uint64_t>(facts.edges));
    EXPECT_EQ(counts.rounds, sweep == Sweep::triangle ? static_cast<std::uint64_t>(facts.rounds) : 0u);
    EXPECT_EQ(counts.triangle_hits,
              sweep == Sweep::triangle ? static_cast<std::uint64_t>(facts.triangles) : 0u);
    EXPECT_EQ(replay.contacts().size(), counts.body.contacts);
    if (sweep == Sweep::triangle) continue;
    for (const std::uint8_t a : replay.answers()) ASSERT_EQ(a & trace_triangle_bits, 0);
  }
}

/// Cells that are no cubes cost the same: without regions, the same walks, crossings and certificates.
/// Regions have oblique sides there, and hold nearly as much.
TEST(Replay, ShearedCellsAreLikeCubes) {
  const Trace& trace = crowded();
  const Environment<3> cubes = trace_environment(trace), leaning = trace_environment(trace, sheared<3>());
  const Trace moved = mapped(trace, sheared<3>());
  EXPECT_NE(moved.start(0, 0), trace.start(0, 0));
  EXPECT_EQ(mapped(trace, {}).targets, trace.targets);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const auto replayed = [sweep](const Environment<3>& environment, const Trace& replayed_trace,
                                  bool clearance) {
      Replay replay(environment.snapshot(), Locator<3>(environment.snapshot()), replayed_trace,
                    {sweep, clearance});
      replay.run();
      EXPECT_EQ(count_mismatches(replayed_trace, replay.answers(), sweep), 0u);
      return replay.counts().body;
    };
    const Edge_counts a = replayed(cubes, trace, false).edges, b = replayed(leaning, moved, false).edges;
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
    EXPECT_GT(static_cast<double>(replayed(leaning, moved, true).in_region),
              0.9 * static_cast<double>(replayed(cubes, trace, true).in_region));
  }
}

/// Bodies that report contacts as well have one for each vertex that stays, at the time at which brute force
/// finds the vertex or the first of its edges that are in the way at a wall.
TEST(Replay, BodiesReportContactsOfTheSameMoves) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  Body_options options = trace_options(Sweep::triangle);
  std::map<std::size_t, Contact<3>> contacts;
  Body_counts counts;
  for (std::uint32_t b = 0; b < trace.bodies; ++b) {
    Body<3> body(environment.snapshot(), locator, test::trace_body_at(&trace.start(b, 0)));
    Body<3> copy = body;
    for (std::uint32_t step = 0; step < trace.steps; ++step) {
      Step_report<3> report;
      const std::span<const Point<3>> targets(&trace.target(step, b, 0), trace_vertices);
      options.reports_blocked = true;
      body.step(targets, options, report, counts);
      options.reports_blocked = false;
      copy.step(targets, options, report, counts);
      std::vector<std::uint8_t> answers;
      append_answers(report.blocked, Sweep::triangle, answers);
      for (std::size_t v = 0; v < trace_vertices; ++v) ASSERT_EQ(answers[v], trace.answer(step, b, v));
      for (const Contact<3>& met : report.contacts)
        EXPECT_TRUE(contacts.emplace(trace.index(step, b, met.vertex), met).second);
    }
  }
  const test::Trace_walls walls(trace);
  int of_vertices = 0, of_edges = 0, of_edges_before = 0;
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    const unsigned answer = trace.answers[i];
    ASSERT_EQ(contacts.count(i), (answer & (trace_segment_bit | trace_edge_bits)) != 0 ? 1u : 0u);
    if (contacts.count(i) == 0) return;
    const Contact<3>& contact = contacts.at(i);
    std::optional<double> first, of_any_edge;
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (const auto time = walls.meet_triangle(from, target, q[k])) {
        of_any_edge = std::min(*time, of_any_edge.value_or(1));
        if ((answer >> (1 + k) & 1) != 0) first = std::min(*time, first.value_or(1));
      }
    if ((answer & trace_segment_bit) != 0) first = walls.meet_triangle(from, target, from);  // its way alone
    ASSERT_TRUE(first);
    if ((answer & trace_segment_bit) != 0 && contact.body == Body_feature::edge) {
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

/// A replay names the wall that is in the way of a vertex, or of an edge at its end.
TEST(Replay, NamesWalls) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    Replay replay(snapshot, locator, trace, {sweep, true});
    replay.run();
    std::map<std::size_t, const Run_contact<3>*> contacts;
    for (const Run_contact<3>& c : replay.contacts())
      EXPECT_TRUE(contacts.emplace(trace.index(c.step - 1, c.body.value(), c.contact.vertex), &c).second);
    int of_vertices = 0, of_edges = 0;
    test::for_each_move(
        trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
          const bool is_vertex = trace.answers[i] & trace_segment_bit;
          ASSERT_EQ(contacts.count(i), is_vertex || trace.answers[i] & trace_edge_bits ? 1u : 0u);
          if (contacts.count(i) == 0) return;
          const Run_contact<3>& c = *contacts.at(i);
          EXPECT_EQ(c.contact.body, is_vertex ? Body_feature::vertex : Body_feature::edge);
          EXPECT_TRUE(snapshot.is_impassable(c.contact.facet));
          EXPECT_NEAR(length(c.contact.normal), 1, 0x1p-40);
          // The point lies on the way of the vertex, or on the edge from its target.
          double off = 1;
          for (const Point<3>& end : q) {
            const Point<3>&a = is_vertex ? from : target, &b = is_vertex ? target : end;
            off = std::min(off, length(c.contact.point - (a + c.contact.time * (b - a))));
          }
          EXPECT_LT(off, 1e-12);
          ++(is_vertex ? of_vertices : of_edges);
        });
    EXPECT_GT(of_vertices, 2000);
    EXPECT_GT(of_edges, 200);
  }
}

/// Where nothing touches a wall, three segments whose first contact decides move bodies as the trace says.
TEST(Replay, SweptSegmentsThatRejectGoTheSameWay) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  Body_options options;
  options.sweep.sweep = Sweep::three_segments;
  options.rule = Step_rule::reject;
  Replay replay(environment.snapshot(), locator, trace, {Sweep::three_segments, true});
  std::vector<Body<3>> bodies;
  for (std::uint32_t b = 0; b < trace.bodies; ++b)
    bodies.emplace_back(environment.snapshot(), locator, test::trace_body_at(&trace.start(b, 0)));
  Step_report<3> report;
  Body_counts counts;
  for (std::uint32_t step = 0; step < trace.steps; ++step) {
    replay.step();
    for (std::uint32_t b = 0; b < trace.bodies; ++b) {
      bodies[b].step({&trace.target(step, b, 0), trace_vertices}, options, report, counts);
      for (std::size_t v = 0; v < trace_vertices; ++v)
        ASSERT_EQ(bodies[b].positions()[v], replay.bodies()[b].positions()[v]);
    }
  }
  EXPECT_EQ(report.contacts.size(), replay.contacts().size());
  EXPECT_EQ(counts.held, replay.counts().body.held);
  EXPECT_GT(counts.held, 2000u);
  EXPECT_EQ(counts.stop_tries, 0u);
}

/// An edge that goes round an obstacle is in the way where what it sweeps counts, and not where its target
/// does.
TEST(Replay, SweptTrianglesRejectWhatGoesRound) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  Body_options options;
  options.rule = Step_rule::reject;
  int rejected = 0;
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto&) {
    const unsigned answer = trace.answers[i];
    if (answer == 0 || (answer & (trace_segment_bit | trace_edge_bits)) != 0) return;
    const auto vertex = static_cast<std::uint32_t>(i % trace_vertices);
    const std::size_t move_in_step = i % (trace.bodies * trace_vertices);
    // The body as it is then: replayed up to this step, and its vertices before this one moved.
    Replay replay(environment.snapshot(), locator, trace, {Sweep::three_segments, false});
    while (replay.steps_done() < i / (trace.bodies * trace_vertices)) replay.step();
    Body<3> body = replay.bodies()[move_in_step / trace_vertices];
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    Step_report<3> report;
    Body_counts counts;
    for (std::uint32_t v = 0; v < vertex; ++v) targets[v] = trace.targets[i - vertex + v];
    body.step(targets, trace_options(Sweep::triangle), report, counts);
    ASSERT_EQ(body.positions()[vertex], from);
    std::ranges::copy(body.positions(), targets.begin());
    targets[vertex] = target;
    Body<3> other = body;
    report.clear();
    body.step(targets, trace_options(Sweep::triangle), report, counts);
    EXPECT_EQ(body.positions()[vertex], target);
    other.step(targets, options, report, counts);
    EXPECT_EQ(other.positions()[vertex], from);
    EXPECT_EQ(report.contacts.size(), 1u);
    ++rejected;
  });
  EXPECT_GT(rejected, 2);
}

TEST(Replay, FalsifiedBitsAreMismatches) {
  Trace trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  trace.answers[7] ^= trace_segment_bit;
  trace.answers[100] ^= 0x20;
  const auto mismatches = [&](Sweep sweep) {
    Replay replay(environment.snapshot(), locator, trace, {sweep, true});
    replay.run();
    return count_mismatches(trace, replay.answers(), sweep);
  };
  EXPECT_EQ(mismatches(Sweep::three_segments), 1u);
  EXPECT_EQ(mismatches(Sweep::triangle), 2u);
}

TEST(Replay, RefusesWhatItCannotReplay) {
  Trace trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  const auto refusal = [&](Error_code code, Sweep sweep) {
    try {
      const Replay replay(environment.snapshot(), locator, trace, {sweep, true});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return std::string(error.what());
    }
    ADD_FAILURE() << "nothing was refused";
    return std::string();
  };
  EXPECT_NE(refusal(Error_code::usage, Sweep::faces).find("no faces"), std::string::npos);
  trace.start_positions[2 * 8 + 5] = {-1, 0.5, 0.5};
  EXPECT_TRUE(refusal(Error_code::outside, Sweep::triangle).starts_with("body 2: vertex 5 of the body"));
}

TEST(TraceEnvironment, HasTheSolidCellsOfTheTrace) {
  const Trace& trace = crowded();
  ASSERT_GT(trace.obstacles.size(), 5u);
  for (const Lattice_map<3>& map : {Lattice_map<3>{}, sheared<3>(), rotated<3>()}) {
    const Environment<3> environment = trace_environment(trace, map);
    const Snapshot<3>& snapshot = environment.snapshot();
    ASSERT_EQ(snapshot.cell_count(), trace.cells());
    std::vector<std::uint32_t> solid;
    for (std::uint32_t i = 0; i < snapshot.cell_count(); ++i)
      if (snapshot.is_solid(snapshot.cell(i))) solid.push_back(i);
    EXPECT_EQ(solid, trace.obstacles);
  }
  Trace too_large;
  too_large.nx = too_large.ny = 1u << 16, too_large.nz = 1;
  EXPECT_THROW(trace_environment(too_large), Error);
}

}  // namespace
}  // namespace cellwalk
