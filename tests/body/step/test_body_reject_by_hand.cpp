// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of traces by hand, in the plane: walls in the line of the motion, touches, edges that go round.
#include <cellwalk/body/body.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "body/rejecting.h"
#include "body/rooms.h"

namespace cellwalk::test {
namespace {

/// Rooms of 8 x 4 cells with a membrane from (3, 2) to (5, 2).
Snapshot<2> rooms_with_membrane() {
  Snapshot<2> snapshot = rooms<2>({8, 4});
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const Half_facet f = snapshot.half_facet(snapshot.cell(i), k);
      const auto loop = snapshot.loop(f);
      const Point<2>&u = snapshot.point(loop[0]), &v = snapshot.point(loop[1]);
      const double middle = (u[0] + v[0]) / 2;
      if (u[1] == 2 && v[1] == 2 && middle > 3 && middle < 5) snapshot.set_impassable(f, true);
    }
  return snapshot;
}

struct Blocked_sets {
  bool is_vertex_blocked;
  std::uint64_t edges, swept_edges;
  bool operator==(const Blocked_sets&) const = default;
};
/// Nothing is told of a move that meets nothing.
constexpr Blocked_sets nothing{false, 0, 0};

/// Moves vertex 0 of a body, all others of which stay; by both kinds of regions.
Blocked_sets blocked_sets(const Snapshot<2>& snapshot, const Body_soup<2>& soup, const Point<2>& target,
                          Sweep sweep, Touch touch) {
  std::vector<Point<2>> targets = soup.points;
  targets[0] = target;
  std::vector<Blocked_sets> answers;
  for (const bool clearance : {false, true}) {
    Body<2> body(snapshot, Locator<2>(snapshot), soup);
    Body_counts counts;
    const auto blocked = reject<2>(body, targets, rejecting(sweep, touch, clearance), counts).blocked;
    const auto first = std::ranges::find(blocked, 0u, &Rejected_move<2>::vertex);
    answers.push_back(first == blocked.end()
                          ? nothing
                          : Blocked_sets{first->is_vertex_blocked, first->edges, first->swept_edges});
    const bool stays = answers.back().is_vertex_blocked || answers.back().edges != 0;
    EXPECT_EQ(body.positions()[0], stays ? soup.points[0] : target);
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
  }
  EXPECT_EQ(answers[0], answers[1]);
  return answers[0];
}

TEST(BodyReject, AlongAWall) {
  const Snapshot<2> snapshot = rooms_with_membrane();
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    const std::uint64_t swept = sweep == Sweep::triangle;
    // A vertex in the line of the membrane, towards it and past it.
    const Body_soup<2> vertex{{{2.5, 2}}, {}, {}};
    EXPECT_EQ(blocked_sets(snapshot, vertex, {5.5, 2}, sweep, Touch::pass), nothing);
    EXPECT_EQ(blocked_sets(snapshot, vertex, {2.875, 2}, sweep, Touch::stop), nothing);
    EXPECT_EQ(blocked_sets(snapshot, vertex, {3, 2}, sweep, Touch::stop), (Blocked_sets{true, 0, 0}));
    EXPECT_EQ(blocked_sets(snapshot, vertex, {5.5, 2}, sweep, Touch::stop), (Blocked_sets{true, 0, 0}));
    // An edge in that line, which its vertex draws out over the membrane.
    const Body_soup<2> edge{{{2.5, 2}, {1.5, 2}}, {{0, 1}}, {}};
    EXPECT_EQ(blocked_sets(snapshot, edge, {5.5, 2}, sweep, Touch::pass), nothing);
    EXPECT_EQ(blocked_sets(snapshot, edge, {5.5, 2}, sweep, Touch::stop), (Blocked_sets{true, 0, 0}));
    // One that the vertex, past its end, lays on the membrane.
    const Body_soup<2> laid{{{5.5, 2.5}, {2.5, 2}}, {{0, 1}}, {}};
    EXPECT_EQ(blocked_sets(snapshot, laid, {5.5, 2}, sweep, Touch::pass), nothing);
    EXPECT_EQ(blocked_sets(snapshot, laid, {5.5, 2}, sweep, Touch::stop), (Blocked_sets{false, 1, swept}));
    // One on the membrane, on its upper side, goes along it and off it, but not through.
    const Body_soup<2> above{{{4.25, 2}, {3.25, 2}, {3.5, 2.5}}, {{0, 1}, {0, 2}, {1, 2}}, {}};
    EXPECT_EQ(blocked_sets(snapshot, above, {4.5, 2}, sweep, Touch::pass), nothing);
    EXPECT_EQ(blocked_sets(snapshot, above, {4.5, 2.5}, sweep, Touch::pass), nothing);
    EXPECT_TRUE(blocked_sets(snapshot, above, {4.5, 1.5}, sweep, Touch::pass).is_vertex_blocked);
    EXPECT_TRUE(blocked_sets(snapshot, above, {4.5, 2.5}, sweep, Touch::stop).is_vertex_blocked)
        << "it is at a wall";
  }
}

TEST(BodyReject, EdgesThatTouchStay) {
  const Snapshot<2> snapshot = rooms_with_membrane();
  // The edge ends on the floor: free to move where that is passed, held where it is a touch.
  const Body_soup<2> soup{{{1.5, 1.5}, {1.5, 0}}, {{0, 1}}, {}};
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    EXPECT_EQ(blocked_sets(snapshot, soup, {1.75, 1.5}, sweep, Touch::pass), nothing);
    EXPECT_EQ(blocked_sets(snapshot, soup, {1.75, 1.5}, sweep, Touch::stop),
              (Blocked_sets{false, 1, std::uint64_t{sweep == Sweep::triangle}}));
  }
}

TEST(BodyReject, EdgesThatGoRoundAreToldAndMove) {
  const Snapshot<2> snapshot = rooms_with_membrane();
  // From in front of the membrane, in its line: the edge sweeps over it, and lies below it then.
  const Body_soup<2> round{{{5.5, 2.5}, {2.5, 2}}, {{0, 1}}, {}};
  // From below: the membrane is between where the vertex goes.
  const Body_soup<2> from_below{{{0.5, 1.5}, {4, 1.5}}, {{0, 1}}, {}};
  for (const Touch touch : {Touch::pass, Touch::stop})
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle, Sweep::faces}) {
      const std::uint64_t swept = sweep != Sweep::three_segments;
      EXPECT_EQ(blocked_sets(snapshot, round, {5.5, 1.5}, sweep, touch), (Blocked_sets{false, 0, swept}));
      EXPECT_EQ(blocked_sets(snapshot, from_below, {2.5, 3.5}, sweep, touch),
                (Blocked_sets{false, 1, swept}));
      Body<2> body(snapshot, Locator<2>(snapshot), from_below);
      Body_counts counts;
      const auto [contacts, blocked] =
          reject<2>(body, std::vector<Point<2>>{{2.5, 3.5}, {4, 1.5}}, rejecting(sweep, touch, true), counts);
      ASSERT_EQ(blocked.size(), 1u);
      EXPECT_TRUE(blocked[0].stays());
      EXPECT_EQ(blocked[0].contact->point, (Point<2>{3.625, 2}))
          << "that is not where the edge would meet it";
      EXPECT_EQ(blocked[0].contact->time, 0.75);
      // Half way, from (1.5, 2.5), the edge meets the end of the membrane.
      ASSERT_EQ(contacts.size(), 1u);
      EXPECT_EQ(contacts[0].body, Body_feature::edge);
      EXPECT_EQ(contacts[0].point, (Point<2>{3, 2}));
    }
}

TEST(BodyReject, VerticesMoveOneAfterTheOther) {
  const Snapshot<2> snapshot = rooms_with_membrane();
  // Twelve vertices in a row, each joined to the next; the first six pass below, the others would pass
  // through the membrane.
  Body_soup<2> soup;
  std::vector<Point<2>> targets;
  for (std::uint32_t v = 0; v < 12; ++v) {
    soup.points.push_back({0.5 + v / 16.0 + (v < 6 ? 0 : 2.75), 1.5});
    targets.push_back(soup.points.back() + Vector<2>{0, 1});
    if (v > 0) soup.edges.push_back({v - 1, v});
  }
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
    Body<2> body(snapshot, Locator<2>(snapshot), soup);
    Body_counts counts;
    const auto blocked = reject<2>(body, targets, rejecting(sweep, Touch::pass, true), counts).blocked;
    ASSERT_EQ(blocked.size(), 6u);
    for (std::uint32_t i = 0; i < 6; ++i) {
      EXPECT_EQ(blocked[i].vertex, 6 + i);
      EXPECT_TRUE(blocked[i].is_vertex_blocked);
    }
    EXPECT_EQ(counts.contacts, 6u);
    EXPECT_EQ(counts.held, 6u);
    EXPECT_EQ(counts.moves, 12u);
  }
}

/// Faces are left alone: walls may pierce them, and a sweep of faces says so afterwards.
TEST(BodyReject, FacesAreLeftAlone) {
  const Snapshot<3> snapshot = rooms<3>({5, 5, 4}, {12});
  const Body_soup<3> soup{
      {{0.25, 0.25, 2.5}, {4.75, 0.25, 2.5}, {2.5, 4.75, 2.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
  std::vector<Point<3>> targets = soup.points;
  for (Point<3>& x : targets) x[2] = 0.5;
  for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle, Sweep::faces}) {
    Body<3> body(snapshot, Locator<3>(snapshot), soup);
    Body_counts counts;
    EXPECT_TRUE(reject<3>(body, targets, rejecting(sweep, Touch::pass, true), counts).blocked.empty());
    EXPECT_TRUE(std::ranges::equal(body.positions(), targets));
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
    Body_options faces;
    faces.sweep.sweep = Sweep::faces;
    EXPECT_THROW(body.move_vertex(0, soup.points[0], faces, counts), Error);
  }
}

TEST(BodyReject, RefusesRulesThatDoNotGoTogetherOrNotWithTheBody) {
  const Snapshot<2> snapshot = rooms<2>({8, 4});
  const auto refuses = [&](std::uint32_t degree, const Body_options& options) {
    Body_soup<2> star{{{1.5, 1.5}}, {}, {}};
    for (std::uint32_t i = 1; i <= degree; ++i) {
      star.points.push_back({1.5 + 0.001 * i, 1.75});
      star.edges.push_back({0, i});
    }
    Body<2> body(snapshot, Locator<2>(snapshot), star);
    std::vector<Point<2>> targets = star.points;
    targets[0] = {1.5, 1.25};
    Step_report<2> report;
    Body_counts counts;
    try {
      body.step(targets, options, report, counts);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::usage);
      EXPECT_EQ(body.positions()[0], star.points[0]);
      return true;
    }
    EXPECT_EQ(body.positions()[0], targets[0]);
    return false;
  };
  for (const bool clearance : {false, true}) {
    const Body_options at_target = rejecting(Sweep::triangle, Touch::pass, clearance);
    EXPECT_FALSE(refuses(64, at_target));
    EXPECT_TRUE(refuses(65, at_target));
    for (const Step_rule rule : {Step_rule::reject, Step_rule::slide}) {
      Body_options swept = at_target;
      swept.rule = rule;
      EXPECT_FALSE(refuses(65, swept));
    }
  }
}

/// A vertex leaves a region for a wall where touching is allowed. What touches since is stopped.
TEST(BodyReject, WhatCameToTouchIsNotTakenToBeApart) {
  const Snapshot<2> snapshot = rooms<2>({1, 1});
  for (const bool clearance : {true, false}) {
    SCOPED_TRACE(clearance);
    Body<2> body(snapshot, Locator<2>(snapshot), {{{0.5, 0.5}, {0.75, 0.5}}, {{0, 1}}, {}});
    Body_options options;
    options.rule = Step_rule::reject_at_target;
    options.sweep.touch = Touch::pass;
    options.clearance = clearance;
    Step_report<2> report;
    Body_counts counts;
    body.step(std::vector<Point<2>>{{0.5, 0.5}, {0.75, 0.51}}, options, report, counts);
    body.step(std::vector<Point<2>>{{0.5, 0.5}, {1, 0.5}}, options, report, counts);
    EXPECT_TRUE(report.contacts.empty());
    options.sweep.touch = Touch::stop;
    body.step(std::vector<Point<2>>{{0.5, 0.51}, {1, 0.5}}, options, report, counts);
    EXPECT_FALSE(report.contacts.empty());
    EXPECT_EQ(body.positions()[0], (Point<2>{0.5, 0.5})) << "its edge touches the wall";
  }
}

}  // namespace
}  // namespace cellwalk::test
