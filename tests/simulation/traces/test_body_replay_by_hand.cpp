// SPDX-License-Identifier: LGPL-3.0-or-later
// Replays of traces of any bodies that are small enough to know the answers by heart.
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

/// An edge in a room with a pillar from x = y = 2 to 3: where its ends are before a step, and their targets.
Body_trace edge_trace(std::vector<std::array<Point<3>, 2>> before,
                      std::vector<std::array<Point<3>, 2>> targets) {
  Body_trace trace;
  trace.bodies = {{2, {{0, 1}}, {}}};
  trace.steps = static_cast<std::uint32_t>(targets.size());
  for (const auto& ends : before) trace.before.insert(trace.before.end(), ends.begin(), ends.end());
  for (const auto& ends : targets) trace.targets.insert(trace.targets.end(), ends.begin(), ends.end());
  return trace;
}

constexpr Point<3> in_plane(double x, double y) { return {x, y, 0.5}; }

TEST(BodyReplay, AnswersByHand) {
  const auto snapshot = rooms<3>({5, 5, 1}, {12});
  const Locator<3> locator(snapshot);
  const struct {
    const char* what;
    std::array<Point<3>, 2> before;
    Point<3> target;  ///< of the first end; the other one stays
    std::array<std::uint8_t, 4> answers;
    bool moves;
  } cases[]{
      {"nothing", {in_plane(0.5, 0.5), in_plane(0.5, 4.5)}, in_plane(1.5, 0.5), {0, 0, 0, 0}, true},
      {"the vertex", {in_plane(1.5, 2.5), in_plane(0.5, 2.5)}, in_plane(4.5, 2.5), {1, 2, 0, 0}, false},
      {"the edge where it goes",
       {in_plane(1.5, 0.5), in_plane(0.5, 2.5)},
       in_plane(4.5, 1.5),
       {0, 3, 0, 0},
       false},
      {"what it sweeps", {in_plane(0.1, 0.1), in_plane(2.5, 4.9)}, in_plane(4.9, 0.1), {0, 2, 0, 0}, true},
      {"a touch", {in_plane(2, 2.25), in_plane(0.5, 2.5)}, in_plane(2, 2.75), {0, 0, 0, 0}, true},
      {"a touch at the end", {in_plane(1, 2.25), in_plane(0.5, 2.5)}, in_plane(2, 2.75), {0, 0, 0, 0}, true},
      {"the outer wall", {in_plane(0.5, 0.5), in_plane(0.5, 1.5)}, in_plane(-0.5, 0.5), {1, 2, 0, 0}, false}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.what);
    const Body_trace trace = edge_trace({c.before, c.before}, {{c.target, c.before[1]}});
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
      Body_replay replay(snapshot, locator, trace, body_trace_options(sweep, trace));
      replay.prepare();
      replay.step();
      EXPECT_TRUE(replay.answers().empty());
      replay.note_answers();
      std::vector<std::uint8_t> expected(c.answers.begin(), c.answers.end());
      if (sweep == Sweep::three_segments)
        for (std::uint8_t& bits : expected) bits &= body_trace_blocked;
      EXPECT_TRUE(std::ranges::equal(replay.answers(), expected));
      EXPECT_EQ(replay.bodies()[0].positions()[0], c.moves ? c.target : c.before[0]);
      EXPECT_EQ(replay.counts().held, c.moves ? 0u : 1u);
      EXPECT_EQ(replay.counts().moves, 2u);
    }
  }
}

/// Before each step bodies stand where the trace says, whatever the step before did and wherever walls are.
TEST(BodyReplay, StandsWhereTheTraceSays) {
  const auto snapshot = rooms<3>({5, 5, 1}, {12});
  const std::array left{in_plane(1.5, 2.25), in_plane(1.5, 2.75)},
      right{in_plane(3.5, 2.25), in_plane(3.5, 2.75)}, far_left{in_plane(0.5, 2.25), in_plane(0.5, 2.75)};
  const Body_trace trace = edge_trace({left, far_left, right, left}, {right, right, far_left});
  const Locator<3> locator(snapshot);
  Body_replay replay(snapshot, locator, trace, body_trace_options(Sweep::triangle, trace));
  const std::uint64_t anew[]{0, 0, 1};
  for (std::uint32_t s = 0; s < trace.steps; ++s) {
    replay.prepare();
    EXPECT_TRUE(std::ranges::equal(replay.bodies()[0].positions(), trace.before_step(s)));
    EXPECT_EQ(replay.registered_anew(), anew[s]);
    replay.step();
    replay.note_answers();
    replay.validate();
    EXPECT_EQ(replay.steps_done(), s + 1);
  }
  EXPECT_TRUE(
      std::ranges::equal(replay.answers(), std::vector<std::uint8_t>{1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2}));
  EXPECT_EQ(replay.counts().moves, 6u) << "what puts bodies in place is not counted";
}

/// A wall may pierce a face, in runs that sweep edges only.
TEST(BodyReplay, FacesDoNotCount) {
  const auto snapshot = rooms<3>({5, 5, 1}, {12});
  Body_trace trace;
  trace.bodies = {{3, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}}};
  trace.steps = 1;
  const Point<3> around[]{in_plane(0.1, 0.1), in_plane(4.9, 0.1), in_plane(2.5, 4.9)};
  for (int i = 0; i < 2; ++i) trace.before.insert(trace.before.end(), std::begin(around), std::end(around));
  trace.targets = {in_plane(0.2, 0.1), around[1], around[2]};
  const Locator<3> locator(snapshot);
  Body_replay replay(snapshot, locator, trace, body_trace_options(Sweep::triangle, trace));
  replay.prepare();
  replay.step();
  replay.note_answers();
  EXPECT_TRUE(std::ranges::equal(replay.answers(), std::vector<std::uint8_t>(3 + 2 * 3)));
  EXPECT_EQ(replay.bodies()[0].positions()[0], trace.targets[0]);
}

std::string body_refusal(Error_code code, const Body_trace& trace, Sweep sweep) {
  const auto snapshot = rooms<3>({5, 5, 1}, {12});
  try {
    const Locator<3> locator(snapshot);
    Body_replay replay(snapshot, locator, trace, body_trace_options(sweep, trace));
    while (replay.steps_done() < trace.steps) replay.prepare(), replay.step();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

TEST(BodyReplay, RefusesWhatItCannotReplay) {
  const std::array left{in_plane(1.5, 2.25), in_plane(1.5, 2.75)};
  const std::array within{in_plane(1.5, 2.25), in_plane(2.5, 2.5)};
  Body_trace trace = edge_trace({left, within, left}, {left, left});
  EXPECT_EQ(body_refusal(Error_code::usage, trace, Sweep::faces),
            "faces are not answered in a trace: replay it by three_segments or triangle");
  EXPECT_TRUE(body_refusal(Error_code::outside, trace, Sweep::triangle)
                  .starts_with("body 0 before step 1: vertex 1 of the body"));
  trace.bodies = {{66, {}, {}}};
  for (std::uint32_t v = 1; v < 66; ++v) trace.bodies[0].edges.push_back({0, v});
  trace.before.assign(66 * 3, in_plane(0.5, 0.5));
  trace.targets.assign(66 * 2, in_plane(0.75, 0.5));
  EXPECT_EQ(
      body_refusal(Error_code::input, trace, Sweep::triangle),
      "body 0: vertex 0 has 65 edges, and traces answer moves of vertices with 64 at most: leave the body "
      "out");
  trace.bodies[0].edges.pop_back();
  const auto snapshot = rooms<3>({5, 5, 1});
  const Locator<3> locator(snapshot);
  Body_replay replay(snapshot, locator, trace, body_trace_options(Sweep::triangle, trace));
  replay.prepare();
  EXPECT_NO_THROW(replay.step());
}

}  // namespace
}  // namespace cellwalk
