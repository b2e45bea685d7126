// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/body.h>
#include <cellwalk/simulation/replay.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
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

/// Cells that are no cubes cost the same: without regions, the same walks, crossings and certificates. Regions have oblique sides
/// there, and hold nearly as much.
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
    EXPECT_EQ(a.edges, b.edges);
    EXPECT_EQ(a.same_cell, b.same_cell);
    EXPECT_EQ(a.convex_pair, b.convex_pair);
    EXPECT_EQ(a.same_chain, b.same_chain);
    EXPECT_EQ(a.event_sweeps, b.event_sweeps);
    // Planes in single precision leave other signs in doubt.
    EXPECT_NEAR(static_cast<double>(a.walk.walks), static_cast<double>(b.walk.walks),
                1e-3 * static_cast<double>(a.walk.walks));
    EXPECT_NEAR(static_cast<double>(a.walk.crossings), static_cast<double>(b.walk.crossings),
                1e-3 * static_cast<double>(a.walk.crossings));
    EXPECT_GT(static_cast<double>(replayed(leaning, moved, true).in_region),
              0.9 * static_cast<double>(replayed(cubes, trace, true).in_region));
  }
}

TEST(Trace_body, NoticesThatTheEnvironmentWasEdited) {
  const Trace& trace = crowded();
  Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  Trace_counts counts;
  Trace_body body(environment.snapshot(), locator, Trace_positions(&trace.start(0, 0), trace_vertices));
  body.move(0, trace.target(0, 0, 0), Sweep::triangle, counts);
  Snapshot<3> edited = environment.snapshot();
  Trace_body other(edited, locator, Trace_positions(&trace.start(0, 0), trace_vertices));
  // Of solid cells all facets are walls already.
  for (std::size_t i = 0; edited.epoch() == environment.snapshot().epoch(); ++i)
    for (std::size_t k = 0; k < 6; ++k) edited.set_impassable(edited.half_facet(edited.cell(i), k), true);
  EXPECT_NO_THROW(body.move(1, trace.target(0, 0, 1), Sweep::triangle, counts)) << "that is another snapshot";
  EXPECT_THROW(other.move(1, trace.target(0, 0, 1), Sweep::triangle, counts), Error);
}

/// Bodies that locate them report a contact for each move with a hit, at the time at which brute force finds the first edge, or the vertex, at a wall.
TEST(Trace_body, ReportsContacts) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  std::map<std::size_t, Contact<3>> contacts;
  Trace_counts counts;
  for (std::uint32_t b = 0; b < trace.bodies; ++b) {
    Trace_body body(environment.snapshot(), locator, Trace_positions(&trace.start(b, 0), trace_vertices));
    for (std::uint32_t step = 0; step < trace.steps; ++step)
      for (std::uint32_t v = 0; v < trace_vertices; ++v) {
        const Trace_body::Move move = body.move(v, trace.target(step, b, v), Sweep::triangle, counts);
        const std::size_t i = trace.index(step, b, v);
        EXPECT_EQ(move.answer, trace.answers[i]);
        if (move.contact) contacts.emplace(i, *move.contact);
      }
  }
  const test::Trace_walls walls(trace);
  int of_vertices = 0, of_edges = 0;
  test::for_each_move(trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
    ASSERT_EQ(contacts.count(i), trace.answers[i] != 0 ? 1u : 0u);
    if (trace.answers[i] == 0) return;
    const Contact<3>& contact = contacts.at(i);
    std::optional<double> first;
    const bool is_vertex = (trace.answers[i] & trace_segment_bit) != 0;
    if (is_vertex) {
      first = walls.meet_triangle(from, target, from);  // no triangle: the way of the vertex alone
    } else {
      for (const Point<3>& end : q)
        if (const auto time = walls.meet_triangle(from, target, end))
          first = std::min(*time, first.value_or(1));
    }
    ASSERT_TRUE(first);
    EXPECT_EQ(contact.body, is_vertex ? Body_feature::vertex : Body_feature::edge);
    EXPECT_NEAR(contact.rounded_time(), *first, 0x1p-50);
    EXPECT_NEAR(length(contact.normal), 1, 0x1p-40);
    ++(is_vertex ? of_vertices : of_edges);
  });
  EXPECT_GT(of_vertices, 2000);
  EXPECT_GT(of_edges, 300);
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
    std::map<std::size_t, const Replay_contact*> contacts;
    for (const Replay_contact& c : replay.contacts())
      EXPECT_TRUE(contacts.emplace(trace.index(c.step, c.body, c.vertex), &c).second);
    int of_vertices = 0, of_edges = 0;
    test::for_each_move(
        trace, [&](std::size_t i, const Point<3>& from, const Point<3>& target, const auto& q) {
          const bool is_vertex = trace.answers[i] & trace_segment_bit;
          ASSERT_EQ(contacts.count(i), is_vertex || trace.answers[i] & trace_edge_bits ? 1u : 0u);
          if (contacts.count(i) == 0) return;
          const Replay_contact& c = *contacts.at(i);
          EXPECT_EQ(c.feature, is_vertex ? Body_feature::vertex : Body_feature::edge);
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

/// A body of the library that holds its vertices at walls goes where the trace says.
TEST(Replay, BodiesThatHoldFollowTheSameRule) {
  const Trace& trace = crowded();
  const Environment<3> environment = trace_environment(trace);
  const Locator<3> locator(environment.snapshot());
  Body_options options;
  options.sweep.sweep = Sweep::three_segments;
  options.hold = true;
  Replay replay(environment.snapshot(), locator, trace, {Sweep::three_segments, true});
  std::vector<Body<3>> bodies;
  for (std::uint32_t b = 0; b < trace.bodies; ++b)
    bodies.emplace_back(environment.snapshot(), locator,
                        trace_body_soup(Trace_positions(&trace.start(b, 0), trace_vertices)));
  std::vector<Body_contact<3>> contacts;
  Body_counts counts;
  for (std::uint32_t step = 0; step < trace.steps; ++step) {
    replay.step();
    for (std::uint32_t b = 0; b < trace.bodies; ++b) {
      bodies[b].step({&trace.target(step, b, 0), trace_vertices}, options, contacts, counts);
      for (std::size_t v = 0; v < trace_vertices; ++v)
        ASSERT_EQ(bodies[b].positions()[v], replay.bodies()[b].positions()[v]);
    }
  }
  EXPECT_EQ(contacts.size(), replay.contacts().size());
  EXPECT_EQ(counts.held, replay.counts().body.contacts);
  EXPECT_GT(counts.held, 2000u);
  EXPECT_EQ(counts.stop_tries, 0u);
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
