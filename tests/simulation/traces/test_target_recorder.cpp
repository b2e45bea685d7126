// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces as they are recorded, touches included.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "simulation/random_trace.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

using test::Corners;

/// A box of side 1/2 with its lowest corner here.
Corners box_at(const Point<3>& low) {
  Corners corners;
  for (std::size_t v = 0; v < 8; ++v)
    for (std::size_t k = 0; k < 3; ++k) corners[v][k] = low[k] + ((v >> k & 1) == 0 ? 0 : 0.5);
  return corners;
}

/// One body in a grid of 3 x 3 x 3 cells, the middle one of which is solid.
struct Room {
  Body_trace start;
  Environment<3> environment;
  Locator<3> locator;

  explicit Room(const Corners& body)
      : start(start_of(body)), environment(trace_environment(*start.grid)), locator(environment.snapshot()) {}

  static Body_trace start_of(const Corners& body) {
    Body_trace trace;
    trace.touch_blocks = true;
    trace.grid = {{3, 3, 3}, {13}};
    trace.bodies = {test::hexahedron()};
    trace.before.assign(body.begin(), body.end());
    return trace;
  }
  Target_recorder recorder() const { return {environment.snapshot(), locator, start}; }
};

template <class Call>
std::string refusal(Error_code code, Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

TEST(TargetRecorder, KeepsTargetsAndAnswers) {
  const Room room(box_at({0.125, 0.25, 0.375}));
  Target_recorder recorder = room.recorder();
  const Corners free = box_at({0.1875, 0.25, 0.375});
  recorder.step(free);
  const Corners out = box_at({-0.25, 0.25, 0.375});  // every vertex with an even number leaves the grid
  recorder.step(out);
  const Body_trace& trace = recorder.trace();
  EXPECT_EQ(trace.steps, 2u);
  ASSERT_EQ(trace.answers.size(), 4 * trace.moves());
  ASSERT_EQ(trace.before.size(), 3u * 8);
  EXPECT_EQ(trace.targets_of_step(0)[3], free[3]);
  EXPECT_EQ(trace.targets_of_step(1)[6], out[6]);
  for (std::size_t v = 0; v < 8; ++v) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(trace.answers[4 * v + i], 0);
      EXPECT_EQ(int{trace.answers[4 * (8 + v) + i]}, v % 2 == 1 ? 0 : i == 0 ? 1 : 2);
    }
    EXPECT_EQ(trace.before_step(2)[v], recorder.bodies()[0].positions()[v]);
    EXPECT_EQ(recorder.bodies()[0].positions()[v], v % 2 == 0 ? free[v] : out[v]);
  }
}

TEST(TargetRecorder, RefusesStartsThatTouch) {
  const std::string message = refusal(Error_code::input, [] { Room(box_at({0, 0.25, 0.25})).recorder(); });
  EXPECT_TRUE(message.starts_with("body 0: its edge from vertex 0 to vertex 1 touches a wall at the start"))
      << message;
  // An edge that passes an edge of the solid cell, its ends off it.
  refusal(Error_code::input, [] {
    Corners corners = box_at({0.25, 0.25, 0.25});
    for (std::size_t v : {4, 5, 6, 7}) corners[v][2] = 0.5;
    corners[1] = {1.25, 0.75, 1.5};
    corners[0] = {0.75, 1.25, 1.5};
    Room(corners).recorder();
  });
  EXPECT_NE(refusal(Error_code::input,
                    [] {
                      Corners corners;
                      corners.fill({0.5, 0.5, 0.5});
                      Room(corners).recorder();
                    })
                .find("in one place"),
            std::string::npos);
  EXPECT_TRUE(refusal(Error_code::outside, [] {
                Room(box_at({1.25, 1.25, 1.25})).recorder();
              }).starts_with("body 0 before step 0: vertex 0 of the body"));
}

/// They are hits in a trace, and so the vertex stays off the wall.
TEST(TargetRecorder, MovesThatTouchAreHits) {
  const auto answer_to = [](const Corners& body, std::size_t vertex, const Point<3>& target) {
    const Room room(body);
    const test::Trace_walls walls(*room.start.grid);
    Target_recorder recorder = room.recorder();
    Corners targets = body;
    recorder.step(targets);  // standing still touches nothing
    EXPECT_EQ(std::ranges::count(recorder.trace().answers, 0), 8 * 4);
    targets[vertex] = target;
    recorder.step(targets);
    std::vector<std::uint8_t> answers;
    std::size_t number = 0;
    test::for_each_recorded_move(recorder.trace(), [&](const test::Recorded_move& move) {
      if (number++ != 8 + vertex) return;
      answers = test::answers_where_touches_block(walls, move.from, move.target, move.neighbours);
      EXPECT_TRUE(std::ranges::equal(move.answers, answers));
    });
    EXPECT_EQ(recorder.bodies()[0].positions()[vertex], body[vertex]);
    return answers;
  };
  const Corners in_corner = box_at({0.25, 0.25, 0.25}), below = box_at({0.75, 1.25, 0.25});
  const std::vector<std::uint8_t> blocked{1, 2, 2, 2};
  EXPECT_EQ(answer_to(in_corner, 0, {0, 0.5, 0.5}), blocked) << "on the boundary";
  EXPECT_EQ(answer_to(in_corner, 7, {1, 1, 1}), blocked) << "on a corner of the solid cell";
  // An edge of the body comes to lie on an edge of that cell.
  EXPECT_EQ(answer_to(below, 4, {0.75, 1.25, 1.25})[0], 0);
}

}  // namespace
}  // namespace cellwalk
