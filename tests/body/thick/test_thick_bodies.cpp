// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies with a radius, by hand.
#include <cellwalk/body/body.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "edge/membrane_environment.h"
#include "edge/thick_oracle.h"
#include "edge/thick_rooms.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

Body_soup<3> rod(std::vector<Point<3>> points, std::vector<double> radii) {
  Body_soup<3> soup;
  soup.points = std::move(points);
  for (std::uint32_t i = 0; i + 1 < soup.points.size(); ++i) soup.edges.push_back({i, i + 1});
  soup.radii = std::move(radii);
  return soup;
}

class InTheMembraneRoom : public ::testing::Test {
 protected:
  const Environment<3> room = room_of(membranes_in_box({0, 0, 0}, {8, 8, 8}, {4}));
};

TEST_F(InTheMembraneRoom, AStopKeepsTheDistanceOfAllEdges) {
  Body<3> body(room, rod({{2, 5, 4}, {2, 4, 4}, {2, 3, 4}}, {1, 0.25}));
  Body_counts counts;
  const std::array<Point<3>, 3> targets{{{2, 5, 4}, {6, 4, 4}, {2, 3, 4}}};
  Step_report<3> report;
  body.step(targets, {}, report, counts);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].time, 0.25);
  EXPECT_EQ(report.contacts[0].normal, (Vector<3>{-1, 0, 0}));
  EXPECT_EQ(report.contacts[0].body, Body_feature::vertex);
  EXPECT_EQ(report.contacts[0].vertex, 1u);
  EXPECT_EQ(body.positions()[1], (Point<3>{3, 4, 4}));
  EXPECT_NO_THROW(body.validate());
}

TEST_F(InTheMembraneRoom, EachEdgeHasItsOwnRadius) {
  // Case 48: the thin edge is stopped at the rim, the thick one is free.
  Body<3> body(room, rod({{6, 7, 4}, {2, 7, 4}, {2, 7, 6}}, {0.25, 1}));
  Body_options reject;
  reject.rule = Step_rule::reject;
  Body_counts counts;
  const auto contact = body.move_vertex(1, {2, 4, 4}, reject, counts);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 0.48913874249067535);
  EXPECT_EQ(contact->body, Body_feature::edge);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_NEAR(contact->normal[1], 0.938819, 1e-6);
  EXPECT_EQ(body.radius(0), 0.25);
  EXPECT_EQ(body.radius(1), 1);
}

TEST_F(InTheMembraneRoom, RadiiMayGrowWhereThereIsRoom) {
  Body<3> body(room, rod({{3, 4, 4}, {3, 5, 4}}, {1}));
  EXPECT_EQ(
      refusal([&] { body.set_radii(std::array{1.5}); }),
      "edge 0 of the body, from vertex 0 at (3, 4, 4) to vertex 1 at (3, 5, 4), is at a distance of 1 from a "
      "wall at (4, 4, 4), in cell 0: less than its radius 1.5");
  EXPECT_EQ(body.radius(0), 1);
  body.set_radii(std::array{0.5});
  body.set_radii(std::array{1.0});
  body.set_radii({});
  EXPECT_EQ(body.radius(0), 0);
  EXPECT_TRUE(body.step(std::array<Point<3>, 2>{{{3.5, 4, 4}, {3, 5, 4}}}).empty());
  EXPECT_THROW(body.set_radii(std::array{1.0}), Error);
}

TEST_F(InTheMembraneRoom, ErrorsNameWhatIsWrong) {
  EXPECT_EQ(refusal([&] {
              Body<3>(room, rod({{3.5, 4, 4}, {2, 4, 4}}, {1}));
            }),
            "edge 0 of the body, from vertex 0 at (3.5, 4, 4) to vertex 1 at (2, 4, 4), is at a distance of "
            "0.5 from "
            "a wall at (4, 4, 4), in cell 0: less than its radius 1");
  Body_soup<3> points;
  points.points = {{2, 4, 4}, {3.5, 4, 4}};
  points.radii = {1};
  EXPECT_EQ(refusal([&] { Body<3>(room, points); }),
            "vertex 1 of the body, at (3.5, 4, 4), is at a distance of 0.5 from a wall at (4, 4, 4), in cell "
            "0: less "
            "than its radius 1");
  EXPECT_EQ(refusal([&] {
              Body<3>(room, rod({{2, 4, 4}, {2, 5, 4}}, {-1}));
            }),
            "radius 0 of the body takes a finite number of at least 0, not -1");
  EXPECT_EQ(refusal([&] {
              Body<3>(room, rod({{2, 4, 4}, {2, 5, 4}}, {1, 2}));
            }),
            "2 radii are given for a body of 1 edges: give one for each, or one for all");
  Body<3> body(room, rod({{2, 4, 4}, {2, 5, 4}}, {1}));
  Body_counts counts;
  Step_report<3> report;
  const auto refused = [&](const auto& choose) {
    Body_options options;
    choose(options);
    return refusal([&] { body.step(body.positions(), options, report, counts); });
  };
  EXPECT_EQ(refused([](Body_options& o) { o.sweep.touch = Touch::stop; }),
            "touch stop: not for motions with a radius, which touch no wall");
}

TEST_F(InTheMembraneRoom, ClearancesAreBounds) {
  const Body<3> body(room, rod({{2, 5, 4}, {2, 4, 4}, {3, 3, 4}}, {1, 0.25}));
  const auto far = body.clearances(10);
  EXPECT_NEAR(far[0], 2, 1e-12);
  EXPECT_NEAR(far[1], 1, 1e-12);
  EXPECT_EQ(body.clearances(0.5), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(body.clearances(0), (std::vector<double>{0, 0}));
  EXPECT_THROW(body.clearances(-1), Error);
}

TEST_F(InTheMembraneRoom, PointsHaveTheRadiusOfTheirBody) {
  Body_soup<3> points;
  points.points = {{2, 4, 4}, {6, 4, 4}};
  points.radii = {0.5};
  Body<3> body(room, points);
  const auto contacts = body.step(std::array<Point<3>, 2>{{{8, 4, 4}, {4, 4, 4}}});
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(body.positions()[0], (Point<3>{3.5, 4, 4}));
  EXPECT_EQ(body.positions()[1], (Point<3>{4.5, 4, 4}));
}

/// Walls that appear beside a body are found by its next registration, and lists of walls before are void.
TEST(ThickBodies, EditsBetweenStepsCount) {
  Environment<3> room = room_of(stretched<3>(oracle::make_cubes(4, 4, 4), {2, 2, 2}));
  const Snapshot<3>& snapshot = room.snapshot();
  Body<3> body(room, rod({{3, 3, 3}, {3, 3, 4}}, {0.5}));
  const auto move_by = [&](double x) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (Point<3>& p : targets) p[0] += x;
    return body.step(targets).size();
  };
  EXPECT_EQ(move_by(0.25), 0u);
  EXPECT_EQ(move_by(-0.25), 0u);
  // The facets x = 4 of both cells that the rod lies in, or on the border of.
  std::vector<Half_facet> facets;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell_view<3> view = snapshot.view(snapshot.cell(i));
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      const auto is_at = [&](const Point<3>& p) {
        return p[0] == 4 && p[1] >= 2 && p[1] <= 4 && p[2] >= 2 && p[2] <= 6;
      };
      if (std::ranges::all_of(view.loop(f), [&](std::uint16_t v) { return is_at(view.point(v)); }))
        facets.push_back(Snapshot<3>::half_facet(snapshot.cell(i), f));
    }
  }
  ASSERT_EQ(facets.size(), 4u);
  for (const Half_facet f : facets) room.set_impassable(f, true);
  EXPECT_THROW(move_by(0.25), Error);  // not registered again
  body.register_again(Locator<3>(snapshot));
  EXPECT_EQ(move_by(0.25), 0u);
  EXPECT_GT(move_by(1), 0u);
  EXPECT_NO_THROW(body.validate());
  EXPECT_LE(body.positions()[0][0], 3.5);
  EXPECT_GT(body.positions()[0][0], 3.5 - 1e-9);

  for (const Half_facet f : facets) room.set_impassable(f, false);
  body.register_again(Locator<3>(snapshot));
  EXPECT_EQ(move_by(0.25), 0u);
  for (const Half_facet f : facets) room.set_impassable(f, true);
  EXPECT_NE(refusal([&] { body.register_again(Locator<3>(snapshot)); }).find("less than its radius 0.5"),
            std::string::npos);
  for (const Half_facet f : facets) room.set_impassable(f, false);
  EXPECT_NO_THROW(body.register_again(Locator<3>(snapshot)));
}

TEST_F(InTheMembraneRoom, SavedBodiesKeepTheirRadii) {
  Body<3> body(room, rod({{2, 5, 4}, {2, 4, 4}, {2, 3, 4}}, {1, 0.25}));
  const std::array<Point<3>, 3> targets{{{2, 5, 4}, {6, 4, 4}, {7, 3, 4}}};
  Body<3> restored = restore_body(room.snapshot(), save(body));
  EXPECT_EQ(restored.radius(1), 0.25);
  EXPECT_EQ(body.step(targets).size(), restored.step(targets).size());
  EXPECT_TRUE(std::ranges::equal(body.positions(), restored.positions()));
  EXPECT_EQ(save(body), save(restored));
  Body<3> copy = body;
  EXPECT_EQ(copy.radius(0), 1);
}

/// A rod that slides along a facet in no plane of an axis, and rests on it.
TEST(ThickBodies, RestOnAnObliqueFacet) {
  const Environment<3> room = room_of(oblique_facet());
  const Thick_oracle<3> oracle(room.snapshot());
  Body<3> body(room, rod({{4, 4, 6}, {4, 5, 6}, {4, 6, 6}}, {1}));
  Body_counts counts;
  for (int step = 0; step < 100; ++step) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (Point<3>& x : targets) x = x + Vector<3>{0.01, 0.005, -0.1};
    Step_report<3> report;
    body.step(targets, {}, report, counts);
    for (std::size_t e = 0; e < 2; ++e)
      ASSERT_TRUE(root_is_at_least(
          oracle.square_to_walls(std::array{body.positions()[e], body.positions()[e + 1]}), 1))
          << step;
  }
  EXPECT_GT(counts.contacts, 100u);
  const auto nearest =
      root_rounded_down(oracle.square_to_walls(std::array<Point<3>, 1>{body.positions()[0]}));
  EXPECT_LT(nearest, 1 + 1e-9);
}

/// A cord of radius 1.2 that is pushed through a channel of 8 by 8, and shaken. By the same arithmetic as its
/// walls, each coordinate across it is at least 1.2 from both.
TEST(ThickBodies, ACordKeepsOffTheWallsOfAChannel) {
  const double radius = 1.2;
  const Environment<3> channel = room_of(stretched<3>(oracle::make_cubes(2, 2, 60), {4, 4, 4}));
  std::vector<Point<3>> points;
  for (int i = 0; i < 40; ++i) points.push_back({4, 4, 80 - 1.5 * i});
  Body<3> cord(channel, rod(points, {radius}));
  Random random(7);
  Body_counts counts;
  int at_walls = 0;
  Vector<3> push{};
  const auto steps = static_cast<int>(oracle::scaled_count(300));
  for (int step = 0; step < steps; ++step) {
    std::vector<Point<3>> targets(cord.positions().begin(), cord.positions().end());
    if (step % 25 == 0) push = {random.real(-1, 1), random.real(-1, 1), random.real(-0.3, 0.4)};
    for (Point<3>& x : targets)
      x = x + 0.4 * push + Vector<3>{random.real(-0.2, 0.2), random.real(-0.2, 0.2), random.real(-0.1, 0.1)};
    Step_report<3> report;
    cord.step(targets, {}, report, counts);
    for (const Point<3>& x : cord.positions())
      for (const std::size_t k : {0, 1}) {
        ASSERT_TRUE(Fraction(x[k]) >= Fraction(radius)) << step;
        ASSERT_TRUE(Fraction(8) - Fraction(x[k]) >= Fraction(radius)) << step;
        at_walls += x[k] < radius + 1e-9 || x[k] > 8 - radius - 1e-9;
      }
  }
  EXPECT_NO_THROW(cord.validate());
  // Whether there is a list depends on what was done before, which is not saved: floods are not counted.
  EXPECT_EQ(counts.edges.floods, 0u);
  if (oracle::is_shortened()) return;
  EXPECT_GT(at_walls, 10 * steps);
}

/// An edge that comes near a spike on its way only is reported, and goes there.
TEST(ThickBodies, TheRuleOfThePaperReportsWhatIsSwept) {
  const std::vector<Point<3>> inside{{0, 0, 4}, {8, 0, 4}, {4, 12, 4}};
  const Environment<3> room = membrane_environment({{{4, 3, 0}, {4, 5, 0}, {4, 4, 4}}}, inside);
  for (const Sweep sweep : {Sweep::triangle, Sweep::three_segments}) {
    Body<3> body(room, rod({inside[0], inside[2]}, {1}));
    Body_options options;
    options.sweep.sweep = sweep;
    options.rule = Step_rule::reject_at_target;
    options.reports_blocked = true;
    Body_counts counts;
    Step_report<3> report;
    body.step(std::array{inside[1], inside[2]}, options, report, counts);
    EXPECT_EQ(body.positions()[0], inside[1]);
    ASSERT_EQ(report.blocked.size(), sweep == Sweep::triangle ? 1u : 0u);
    if (!report.blocked.empty()) {
      EXPECT_EQ(report.blocked[0].swept_edges, 1u);
      EXPECT_FALSE(report.blocked[0].stays());
    }
    // By other rules the triangle decides, or both segments.
    options.rule = Step_rule::reject;
    EXPECT_EQ(body.move_vertex(0, inside[0], options, counts).has_value(), sweep == Sweep::triangle);
  }
}

/// Case 46: the face, but none of its edges, comes near the tip of a wall.
TEST(ThickBodies, AFaceMeetsASpike) {
  const std::vector<Point<3>> inside{{4, 9, 6}, {0, 0, 6}, {8, 0, 6}};
  const Environment<3> room = membrane_environment({{{4, 3, 0}, {4, 5, 0}, {4, 4, 4}}}, inside);
  Body_soup<3> soup;
  soup.points = inside;
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  soup.faces = {{0, 1, 2}};
  soup.radii = {1};
  const Point<3> target{4, 9, 2};
  Body_options options;
  options.rule = Step_rule::reject;
  Body_counts counts;
  Body<3> without_faces(room, soup);
  EXPECT_FALSE(without_faces.move_vertex(0, target, options, counts));
  options.sweep.sweep = Sweep::faces;
  Body<3> body(room, soup);
  const auto contact = body.move_vertex(0, target, options, counts);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->time, 0.5461651584688989);
  EXPECT_EQ(contact->body, Body_feature::face);
  EXPECT_EQ(contact->kind, Contact_kind::vertex);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_EQ(contact->point, (Point<3>{4, 4, 4}));
  EXPECT_EQ(body.positions()[0], inside[0]);
  // Faces that were left alone are measured when they are swept again.
  EXPECT_EQ(refusal([&] { without_faces.move_vertex(0, target, options, counts); }).substr(0, 120),
            "face 0 of the body, with vertices 0 at (4, 9, 2), 1 at (0, 0, 6) and 2 at (8, 0, 6), is at a "
            "distance of 0.2030692330267");
  // By the rule of the paper nobody looks at it.
  Body_options of_paper = options;
  of_paper.rule = Step_rule::reject_at_target;
  of_paper.reports_blocked = true;
  Step_report<3> report;
  without_faces = Body<3>(room, soup);
  without_faces.step(std::array{target, inside[1], inside[2]}, of_paper, report, counts);
  EXPECT_TRUE(report.blocked.empty());
  // The radius of a face is the least of its sides'.
  soup.radii = {1, 1, 0.125};
  Body<3> thinner(room, soup);
  const auto later = thinner.move_vertex(0, target, options, counts);
  EXPECT_FALSE(later) << later->time;
  thinner.validate();
  // A face with a side without a radius has none: it may touch the tip, and go no further.
  soup.radii = {1, 1, 0};
  Body<3> thin(room, soup);
  const auto touched = thin.move_vertex(0, {4, 9, 0}, options, counts);
  ASSERT_TRUE(touched);
  EXPECT_EQ(touched->time, 0.75);
  EXPECT_EQ(touched->body, Body_feature::face);
  EXPECT_THROW(thinner.set_radii(std::array{1.0}), Error);
}

TEST_F(InTheMembraneRoom, TheRuleOfThePaperMeasuresTheWayAndTheEnd) {
  Body<3> body(room, rod({{2, 1, 4}, {2, 4, 4}}, {0.5}));
  Body_options options;
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = true;
  Body_counts counts;
  const auto step_to = [&](const Point<3>& p) {
    Step_report<3> report;
    body.step(std::array<Point<3>, 2>{p, body.positions()[1]}, options, report, counts);
    return report.blocked;
  };
  // Beside the rim, and past it: only the edge sweeps what is near.
  EXPECT_TRUE(step_to({2, 1.25, 4}).empty());
  auto blocked = step_to({3.75, 4, 4});
  ASSERT_EQ(blocked.size(), 1u);
  EXPECT_TRUE(blocked[0].is_vertex_blocked);
  EXPECT_EQ(blocked[0].contact->body, Body_feature::vertex);
  EXPECT_EQ(blocked[0].contact->point[0], 4);
  // The way keeps off the rim, the edge would cross the membrane.
  blocked = step_to({6, 1, 4});
  ASSERT_EQ(blocked.size(), 1u);
  EXPECT_FALSE(blocked[0].is_vertex_blocked);
  EXPECT_EQ(blocked[0].edges, 1u);
  EXPECT_EQ(blocked[0].swept_edges, 1u);
  EXPECT_EQ(blocked[0].contact->body, Body_feature::edge);
  EXPECT_EQ(body.positions()[0], (Point<3>{2, 1.25, 4}));
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());

  options.reports_blocked = false;
  Step_report<3> report;
  body.step(std::array<Point<3>, 2>{{{6, 1, 4}, {2, 4, 4}}}, options, report, counts);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].body, Body_feature::edge);
  EXPECT_EQ(report.contacts[0].feature, 0u);
  EXPECT_EQ(report.contacts[0].vertex, 0u);
}

}  // namespace
}  // namespace cellwalk::test
