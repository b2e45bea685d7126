// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces of any bodies: recorded in worlds, replayed, and judged by brute force.
#include <cellwalk/internal/simulation/body_replay.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <span>
#include <vector>

#include "simulation/recorded_motions.h"
#include "simulation/replayed.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

using test::crowd;
using test::crowd_shapes;
using test::crowded_rooms;
using test::Recorded_motion;
using test::rooms;
using test::solid_rooms;
using test::tube_motion;

std::uint64_t count_answers(const Body_trace& trace, std::uint8_t bits) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(trace.answers, [&](std::uint8_t a) { return (a & bits) == bits; }));
}

std::uint64_t mismatches_of(const Snapshot<3>& snapshot, const Body_trace& trace, const Body_options& options,
                            bool validates = false) {
  return test::replayed(snapshot, trace, options, validates).mismatches;
}

TEST(BodyReplay, GivesTheRecordedAnswers) {
  for (const Recorded_motion* motion : {&crowded_rooms(), &tube_motion()}) {
    const Body_trace& trace = motion->trace;
    ASSERT_EQ(trace.answers.size(), trace.steps * trace.answers_of_step());
    EXPECT_GT(count_answers(trace, body_trace_blocked), 80u);
    EXPECT_GT(count_answers(trace, body_trace_swept), 100u);
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
      EXPECT_EQ(mismatches_of(motion->snapshot, trace, body_trace_options(sweep, trace), true), 0u);
      for (const bool clearance : {true, false})
        for (const bool certificates : {true, false}) {
          Body_options options = body_trace_options(sweep, trace);
          options.clearance = clearance;
          options.sweep.certificates = certificates;
          EXPECT_EQ(mismatches_of(motion->snapshot, trace, options), 0u);
        }
    }
  }
}

/// What is recorded is what the bodies of the world are asked, which know nothing of it.
TEST(BodyReplay, RecordingChangesNothing) {
  const Snapshot<3>& snapshot = crowded_rooms().snapshot;
  const Body_trace& trace = crowded_rooms().trace;
  World<3> world(snapshot, crowd(), crowd_shapes());
  ASSERT_EQ(world.bodies().size(), 18u);
  ASSERT_EQ(trace.bodies.size(), 18u);
  EXPECT_EQ(trace.bodies[0].faces.size(), 0u);
  EXPECT_EQ(trace.bodies[8].faces.size(), 12u);
  EXPECT_EQ(trace.bodies[14].vertices, 42u);
  EXPECT_EQ(trace.bodies[17].edges.size(), 15u);
  const auto stand_as_recorded = [&](std::size_t step) {
    std::vector<Point<3>> all;
    for (const auto& moving : world.bodies())
      all.insert(all.end(), moving.body().positions().begin(), moving.body().positions().end());
    return std::ranges::equal(all, trace.before_step(step));
  };
  for (std::uint32_t s = 0; s < trace.steps; ++s) {
    ASSERT_TRUE(stand_as_recorded(s)) << s;
    world.step();
    EXPECT_TRUE(std::ranges::equal(world.bodies()[17].targets(), trace.targets_of_step(s).last(16)));
  }
  EXPECT_TRUE(stand_as_recorded(trace.steps)) << "where they are after the last step";
}

struct Judged_answers {
  int asked = 0, blocked = 0;
  int wrong = 0;    ///< blocked without a wall, or bits that do not go together
  int touches = 0;  ///< free, and a wall is met: only touched, if the answer is right
};

/// Holds the answers against brute force over the closed walls of a grid: all that are not plain, and some
/// others.
Judged_answers judge_answers(const Body_trace& trace, const std::vector<std::uint32_t>& solid) {
  const test::Trace_walls walls({{6, 5, 4}, solid});
  Judged_answers judged;
  const auto judge = [&judged](bool is_blocked, bool meets) {
    ++judged.asked;
    judged.blocked += is_blocked;
    judged.wrong += is_blocked && !meets;
    judged.touches += !is_blocked && meets;
  };
  std::size_t number = 0;
  test::for_each_recorded_move(trace, [&](const test::Recorded_move& move) {
    const bool is_plain = std::ranges::all_of(move.answers, [](unsigned a) { return a == 0; });
    if (is_plain && ++number % 10 != 0) return;
    judge(move.is_blocked(), walls.meet_segment(move.from, move.target));
    judged.wrong += move.answers[0] > 1;
    for (std::size_t i = 0; i < move.neighbours.size(); ++i) {
      if (move.is_blocked()) {
        judged.wrong += move.answers[1 + i] != body_trace_swept;
        continue;
      }
      const Point<3>& q = move.neighbours[i];
      judge(move.is_blocked_at_end(i), walls.meet_segment(move.target, q));
      judge(move.is_swept(i), walls.meet_triangle(move.from, move.target, q).has_value());
    }
  });
  return judged;
}

TEST(BodyReplay, AnswersAreThoseOfBruteForce) {
  const Body_trace& trace = crowded_rooms().trace;
  const Judged_answers judged = judge_answers(trace, solid_rooms);
  EXPECT_GT(judged.asked, 10000);
  EXPECT_GT(judged.blocked, 500);
  EXPECT_EQ(judged.wrong, 0);
  EXPECT_EQ(judged.touches, 0) << "nothing but walls that are touched may be passed over";
  std::cout << judged.asked << " answers judged, " << judged.blocked << " of them blocked\n";
}

TEST(BodyReplay, WrongWallsAreNoticed) {
  const Body_trace& trace = crowded_rooms().trace;
  for (std::size_t i = 0; i < solid_rooms.size(); ++i) {
    std::vector<std::uint32_t> solid = solid_rooms;
    solid.erase(solid.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_GT(judge_answers(trace, solid).wrong, 0) << solid_rooms[i];
    EXPECT_GT(mismatches_of(rooms<3>({6, 5, 4}, solid), trace, body_trace_options(Sweep::triangle, trace)),
              0u);
  }
  std::vector<std::uint32_t> solid = solid_rooms;
  solid.insert(solid.begin(), 1);
  const Judged_answers judged = judge_answers(trace, solid);
  EXPECT_GT(judged.touches, 0);
}

TEST(BodyReplay, FalsifiedAnswersAreMismatches) {
  const Snapshot<3>& snapshot = crowded_rooms().snapshot;
  Body_trace trace = crowded_rooms().trace;
  trace.answers[7] ^= body_trace_blocked;
  trace.answers[100] ^= body_trace_swept;
  trace.answers.back() ^= body_trace_bits;
  EXPECT_EQ(mismatches_of(snapshot, trace, body_trace_options(Sweep::three_segments, trace)), 2u);
  EXPECT_EQ(mismatches_of(snapshot, trace, body_trace_options(Sweep::triangle, trace)), 4u);
  const auto half = std::span<const std::uint8_t>(trace.answers).first(trace.answers.size() - 3);
  EXPECT_EQ(count_mismatches(trace, half, Sweep::triangle), 6u) << "missing answers differ";
  EXPECT_EQ(count_mismatches(trace, half, Sweep::three_segments), 3u);
}

}  // namespace
}  // namespace cellwalk
