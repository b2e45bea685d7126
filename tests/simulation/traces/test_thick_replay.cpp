// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces of bodies with a radius: recorded, replayed, and judged by distances in rational arithmetic.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/internal/simulation/target_recorder.h>
#include <cellwalk/internal/simulation/trace_environment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "edge/thick_oracle.h"
#include "simulation/recorded_motions.h"
#include "simulation/replayed.h"
#include "simulation/trace_oracle.h"

namespace cellwalk {
namespace {

using test::Recorded_motion;
using test::Recorded_move;

/// The crowd with radii, which pushes against walls.
const Recorded_motion& thick_crowd() {
  static const Recorded_motion motion = [] {
    Scene<3> scene = test::crowd();
    double radius = 0;
    for (Body_start<3>& start : scene.bodies) start.edge_radius = radius += 0.04;
    scene.catheter->radius = 0.1;
    scene.steps = 60;
    return test::record_motion(test::rooms<3>({6, 5, 4}, test::solid_rooms), scene, test::crowd_shapes());
  }();
  return motion;
}

/// A star whose edges have radii of their own, one of them none, thrown about.
Body_trace thick_stars() {
  Body_trace start;
  start.grid = {{4, 4, 4}, {5, 22, 42, 63}};
  start.bodies.push_back({4, {{0, 1}, {0, 2}, {0, 3}}, {}, {0.25, 0, 0.0625}});
  start.before = {{2.5, 2.5, 0.5}, {3, 2.5, 0.5}, {2.5, 3, 0.5}, {2.5, 2.5, 1}};
  const Environment<3> environment = trace_environment(*start.grid);
  const Locator<3> locator(environment.snapshot());
  Target_recorder recorder(environment.snapshot(), locator, std::move(start));
  Random random(3);
  for (int step = 0; step < 400; ++step) {
    const Vector<3> drift{random.real(-0.7, 0.7), random.real(-0.7, 0.7), random.real(-0.7, 0.7)};
    std::vector<Point<3>> targets;
    for (const Point<3>& x : recorder.bodies()[0].positions()) {
      Point<3> target = x + drift;
      for (double& c : target) c += random.real(-0.2, 0.2);
      targets.push_back(target);
    }
    recorder.step(targets);
  }
  return recorder.trace();
}

/// The radii of the edges of a vertex, by their other ends.
std::vector<double> radii_at(const Traced_body& body, std::uint32_t vertex) {
  std::vector<double> radii;
  for (std::uint32_t q = 0; q < body.vertices; ++q) {
    const auto edge = std::ranges::find(body.edges, std::array{std::min(vertex, q), std::max(vertex, q)});
    if (edge == body.edges.end()) continue;
    const auto number = static_cast<std::size_t>(edge - body.edges.begin());
    radii.push_back(body.radii.size() == 1 ? body.radii[0] : body.radii[number]);
  }
  return radii;
}

struct Judged {
  int blocked = 0, blocked_at_end = 0, only_swept = 0;
};

/// Holds all answers that are about a radius against the definition.
Judged judge_thick(const Snapshot<3>& snapshot, const Body_trace& trace) {
  const test::Thick_oracle<3> oracle(snapshot);
  const auto is_near = [&](double r, std::vector<Point<3>> points) {
    return r > 0 && !oracle.nearer_than(r, points).empty();
  };
  Judged judged;
  test::for_each_recorded_move(trace, [&](const Recorded_move& move) {
    const std::vector<double> radii = radii_at(trace.bodies[move.body], move.vertex);
    const double largest = *std::ranges::max_element(radii);
    const bool has_thin = std::ranges::count(radii, 0.0) > 0;
    const bool is_blocked = is_near(largest, {move.from, move.target});
    judged.blocked += is_blocked;
    if (is_blocked || !has_thin) {
      EXPECT_EQ(move.is_blocked(), is_blocked) << "step " << move.step << ", vertex " << move.vertex;
    }
    for (std::size_t i = 0; i < radii.size() && !move.is_blocked(); ++i) {
      if (radii[i] == 0) continue;
      const Point<3>& q = move.neighbours[i];
      const bool at_end = is_near(radii[i], {move.target, q});
      const bool swept = is_near(radii[i], {move.from, move.target, q});
      EXPECT_EQ(move.is_blocked_at_end(i), at_end) << "step " << move.step << ", vertex " << move.vertex;
      EXPECT_EQ(move.is_swept(i), swept) << "step " << move.step << ", vertex " << move.vertex;
      judged.blocked_at_end += at_end;
      judged.only_swept += swept && !at_end;
    }
  });
  return judged;
}

void expect_replayed(const Snapshot<3>& snapshot, const Body_trace& trace) {
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const auto replayed = test::replayed(snapshot, trace, body_trace_options(sweep, trace), true);
    EXPECT_EQ(replayed.mismatches, 0u);
  }
  Body_trace thin = trace;
  for (Traced_body& body : thin.bodies) body.radii.clear();
  EXPECT_GT(test::replayed(snapshot, thin, body_trace_options(Sweep::triangle, thin)).mismatches, 50u);
}

TEST(ThickReplay, RecordsWhatABodyKeeps) {
  const Body_trace& trace = thick_crowd().trace;
  EXPECT_EQ(trace.bodies[0].radii, (std::vector<double>{0.04}));
  EXPECT_EQ(trace.bodies[17].radii, (std::vector<double>{0.1}));
  const Judged judged = judge_thick(thick_crowd().snapshot, trace);
  EXPECT_GT(judged.blocked, 50);
  EXPECT_GT(judged.blocked_at_end, 10);
}

TEST(ThickReplay, GivesTheRecordedAnswers) { expect_replayed(thick_crowd().snapshot, thick_crowd().trace); }

TEST(ThickReplay, EachEdgeHasItsRadius) {
  const Body_trace trace = thick_stars();
  const Environment<3> environment = trace_environment(*trace.grid);
  const Judged judged = judge_thick(environment.snapshot(), trace);
  EXPECT_GT(judged.blocked, 100);
  EXPECT_GT(judged.blocked_at_end, 20);
  EXPECT_GT(judged.only_swept, 0);
  expect_replayed(environment.snapshot(), trace);
}

TEST(ThickReplay, AnswersByHand) {
  // A thick edge from vertex 0 to 1 and a thin one to 2; a solid cell from (2,0,0) to (3,1,1).
  Body_trace start;
  start.grid = {{4, 2, 2}, {2}};
  start.bodies.push_back({3, {{0, 1}, {0, 2}}, {}, {0.4375, 0}});
  start.before = {{1.5, 1.5, 0.5}, {3.5, 1.5, 0.5}, {1.5, 1.5, 1}};
  const Environment<3> environment = trace_environment(*start.grid);
  const Locator<3> locator(environment.snapshot());
  Target_recorder recorder(environment.snapshot(), locator, start);
  std::vector<Point<3>> targets = start.before;
  const auto answers_to = [&](std::size_t vertex, const Point<3>& target) {
    targets = {recorder.bodies()[0].positions().begin(), recorder.bodies()[0].positions().end()};
    targets[vertex] = target;
    recorder.step(targets);
    const auto& answers = recorder.trace().answers;
    return std::vector<int>(answers.end() - 7, answers.end());
  };
  using Answers = std::vector<int>;  // of vertex 0 and its two edges, of the others and one each
  EXPECT_EQ(answers_to(0, {1.5, 1.5, 0.4375}), (Answers{0, 0, 0, 0, 0, 0, 0})) << "at its radius";
  EXPECT_EQ(answers_to(0, {1.5, 1.5, 0.375}), (Answers{1, 2, 2, 0, 0, 0, 0})) << "nearer";
  EXPECT_EQ(answers_to(0, {1.5, 1.25, 0.5}), (Answers{0, 3, 0, 0, 0, 0, 0})) << "near the edge of the cell";
  EXPECT_EQ(answers_to(2, {1.5, 1.5, 0.0625}), (Answers{0, 0, 0, 0, 0, 0, 0})) << "the thin one";
}

}  // namespace
}  // namespace cellwalk
