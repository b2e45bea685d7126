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

using Corners = std::array<Point<3>, trace_vertices>;

/// A box of side 1/2 with its lowest corner here.
Corners box_at(const Point<3>& low) {
  Corners corners;
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < 3; ++k) corners[v][k] = low[k] + ((v >> k & 1) == 0 ? 0 : 0.5);
  return corners;
}

/// One body in a grid of 3 x 3 x 3 cells, the middle one of which is solid.
struct Room {
  Trace start;
  Environment<3> environment;
  Locator<3> locator;

  explicit Room(const Corners& body)
      : start(start_of(body)), environment(trace_environment(start)), locator(environment.snapshot()) {}

  static Trace start_of(const Corners& body) {
    Trace trace;
    trace.nx = trace.ny = trace.nz = 3;
    trace.obstacles = {13};
    trace.bodies = 1;
    trace.start_positions.assign(body.begin(), body.end());
    return trace;
  }
  Trace_recorder recorder() const { return {environment.snapshot(), locator, start}; }
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

TEST(TraceRecorder, KeepsTargetsAndAnswers) {
  const Room room(box_at({0.125, 0.25, 0.375}));
  Trace_recorder recorder = room.recorder();
  const Corners free = box_at({0.1875, 0.25, 0.375});
  recorder.step(free);
  const Corners out = box_at({-0.25, 0.25, 0.375});  // every vertex with an even number leaves the grid
  recorder.step(out);
  const Trace& trace = recorder.trace();
  EXPECT_EQ(trace.steps, 2u);
  ASSERT_EQ(trace.moves(), trace.answers.size());
  EXPECT_EQ(trace.target(0, 0, 3), free[3]);
  EXPECT_EQ(trace.target(1, 0, 6), out[6]);
  for (std::size_t v = 0; v < trace_vertices; ++v) {
    EXPECT_EQ(trace.answer(0, 0, v), 0);
    EXPECT_EQ(int{trace.answer(1, 0, v)}, v % 2 == 0 ? 0x71 : 0);
    EXPECT_EQ(recorder.bodies()[0].positions()[v], v % 2 == 0 ? free[v] : out[v]);
  }
  EXPECT_EQ(recorder.counts().moves, 16u);
  EXPECT_EQ(recorder.counts().held, 4u);
}

TEST(TraceRecorder, RefusesStartsThatTouch) {
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
              }).starts_with("body 0: vertex 0 of the body"));
}

/// They are hits in a trace, and so the vertex stays off the wall.
TEST(TraceRecorder, MovesThatTouchAreHits) {
  const auto answer_to = [](const Corners& body, std::size_t vertex, const Point<3>& target) {
    const Room room(body);
    const test::Trace_walls walls(room.start);
    Trace_recorder recorder = room.recorder();
    Corners targets = body;
    recorder.step(targets);  // standing still touches nothing
    EXPECT_EQ(std::ranges::count(recorder.trace().answers, 0), 8);
    targets[vertex] = target;
    recorder.step(targets);
    const unsigned answer = recorder.trace().answer(1, 0, vertex);
    std::array<Point<3>, trace_edges> q;
    for (std::size_t k = 0; k < trace_edges; ++k) q[k] = body[trace_neighbour(vertex, k)];
    EXPECT_EQ(answer, test::answer(walls, body[vertex], target, q));
    EXPECT_EQ(recorder.bodies()[0].positions()[vertex], body[vertex]);
    return answer;
  };
  const Corners in_corner = box_at({0.25, 0.25, 0.25}), below = box_at({0.75, 1.25, 0.25});
  EXPECT_EQ(answer_to(in_corner, 0, {0, 0.5, 0.5}), 0x71u) << "on the boundary";
  EXPECT_EQ(answer_to(in_corner, 7, {1, 1, 1}), 0x71u) << "on a corner of the solid cell";
  // An edge of the body comes to lie on an edge of that cell.
  EXPECT_EQ(answer_to(below, 4, {0.75, 1.25, 1.25}) & trace_segment_bit, 0u);
}

}  // namespace
}  // namespace cellwalk
