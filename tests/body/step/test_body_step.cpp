// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps of bodies by hand: where they stop, what they report, and how they go on.
#include <cellwalk/body/body.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {
namespace {

template <int D>
std::vector<Point<D>> shifted(const Body<D>& body, const Vector<D>& by) {
  std::vector<Point<D>> targets;
  for (const Point<D>& x : body.positions()) targets.push_back(x + by);
  return targets;
}

Body<3> hexahedron(const Snapshot<3>& snapshot, const Point<3>& at, double side) {
  Body_placement<3> placement;
  placement.position = at;
  return Body<3>(snapshot, Locator<3>(snapshot), transformed(hexahedron_body(side, false), placement));
}

TEST(BodyStep, SlidesAlongAnAxisAlignedWall) {
  const Snapshot<3> snapshot = rooms<3>({8, 4, 4}, {});
  Body<3> body = hexahedron(snapshot, {2, 2, 0.5}, 1);  // stands on the floor
  Step_report<3> report;
  Body_counts counts;
  for (int k = 0; k < 40; ++k) {
    body.step(shifted<3>(body, {0.1, 0, -0.05}), {}, report, counts);  // pressed down and pulled along
    body.refresh(counts);
    ASSERT_NO_THROW(body.validate());
  }
  EXPECT_GT(body.positions()[0][0], 5.4) << "it stuck to the floor";
  EXPECT_LT(body.positions()[0][2], 1e-9);
  ASSERT_FALSE(report.contacts.empty());
  EXPECT_EQ(report.contacts[0].normal, (Vector<3>{0, 0, 1}));
}

TEST(BodyStep, RejectsMovesThatMeetWalls) {
  const Snapshot<3> snapshot = rooms<3>({4, 4, 4}, {});
  Body<3> body = hexahedron(snapshot, {1, 2, 2}, 1);
  const std::vector<Point<3>> before(body.positions().begin(), body.positions().end());
  const std::vector<Point<3>> targets = shifted<3>(body, {-0.75, 0.125, 0});
  Body_options options;
  options.rule = Step_rule::reject;
  Step_report<3> report;
  Body_counts counts;
  body.step(targets, options, report, counts);
  // The four vertices on the side of the wall x = 0 would pass it, the others go all the way.
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_EQ(body.positions()[v], before[v][0] < 1 ? before[v] : targets[v]) << v;
  EXPECT_EQ(report.contacts.size(), 4u);
  EXPECT_EQ(counts.held, 4u);
  EXPECT_EQ(counts.stop_tries, 0u);
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

TEST(BodyStep, TouchesCountBeforeAVertexIsBlocked) {
  const Snapshot<2> snapshot = rooms<2>({4, 4}, {});
  const Locator<2> locator(snapshot);
  Body_options options;
  Body_counts counts;
  // On the floor, along it, and through the wall at its end: by itself, and through an edge in its line.
  for (const std::vector<std::array<std::uint32_t, 2>>& edges :
       {std::vector<std::array<std::uint32_t, 2>>{}, {{0, 1}}}) {
    Body<2> body(snapshot, locator, {{{1, 0}, {2, 0}}, edges, {}});
    for (const auto& [touch, time] : {std::pair{Touch::pass, 0.6}, {Touch::stop, 0.0}}) {
      options.sweep.touch = touch;
      const auto contact = body.move_vertex(0, {6, 0}, options, counts);
      ASSERT_TRUE(contact);
      EXPECT_DOUBLE_EQ(contact->time, time) << edges.size() << " edges";
    }
  }
}

TEST(BodyStep, SlidesAlongAnObliqueWall) {
  // A channel whose floor rises: by no angle at which anything is a double.
  Cell_soup<2> soup;
  for (int i = 0; i <= 10; ++i) {
    soup.points.push_back({static_cast<double>(i), 0.3 * i});
    soup.points.push_back({static_cast<double>(i), 0.3 * i + 2});
  }
  for (std::uint32_t i = 0; i < 10; ++i)
    add_polygon(soup, std::array{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  const Snapshot<2> snapshot = compile(soup);
  Body_placement<2> placement;
  placement.position = {1, 1.3};
  Body<2> body(snapshot, Locator<2>(snapshot), transformed(quad_body(0.5), placement));
  Step_report<2> report;
  Body_counts counts;
  for (int k = 0; k < 160; ++k) {
    body.step(shifted<2>(body, {0.07, -0.02}), {}, report, counts);
    body.refresh(counts);
    ASSERT_NO_THROW(body.validate());
  }
  EXPECT_GT(body.positions()[0][0], 8) << "it stuck to the wall";
  EXPECT_GT(report.contacts.size(), 20u);
  EXPECT_LT(counts.held, report.contacts.size() / 2);
  EXPECT_LT(counts.stop_tries, 1.05 * static_cast<double>(report.contacts.size()))
      << "the rounding along the normal comes first";
}

TEST(BodyStep, ReportsTheEdgeThatMeetsASpike) {
  // A solid cell sticks out of the floor; an edge longer than it is wide comes down on it.
  const Snapshot<3> snapshot = rooms<3>({5, 3, 4}, {7});
  const Body_soup<3> soup{{{0.5, 1.25, 2.5}, {4.5, 1.25, 2.5}}, {{0, 1}}, {}};
  Body<3> body(snapshot, Locator<3>(snapshot), soup);
  Body_counts counts;
  const auto contact = body.move_vertex(0, {0.5, 1.25, 0.05}, {}, counts);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->body, Body_feature::edge);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_EQ(contact->vertex, 0u);
  EXPECT_EQ(contact->kind, Contact_kind::edge);
  // The edge meets (2, 1.25, 1): on a line with (4.5, 1.25, 2.5), p is then at height 0.1.
  EXPECT_NEAR(contact->time, 2.4 / 2.45, 1e-12);
  EXPECT_EQ(contact->point[1], 1.25);
  EXPECT_EQ(body.positions()[0], (Point<3>{0.5, 1.25, 2.5})) << "nothing moves where there is a contact";
}

/// A face wider than the solid cell that sticks out of the floor under it.
TEST(BodyStep, FacesAreStoppedByWhatEdgesMiss) {
  const Snapshot<3> snapshot = rooms<3>({5, 5, 4}, {12});
  const Locator<3> locator(snapshot);
  const Body_soup<3> soup{
      {{0.25, 0.25, 2.5}, {4.75, 0.25, 2.5}, {2.5, 4.75, 2.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
  for (const Sweep sweep : {Sweep::triangle, Sweep::faces}) {
    Body<3> body(snapshot, locator, soup);
    Body_options options;
    options.sweep.sweep = sweep;
    Step_report<3> report;
    Body_counts counts;
    for (int k = 0; k < 30; ++k) {
      body.step(shifted<3>(body, {0, 0, -0.07}), options, report, counts);
      body.refresh(counts);
      ASSERT_NO_THROW(body.validate()) << k;
    }
    double lowest = 4;
    for (const Point<3>& x : body.positions()) lowest = std::min(lowest, x[2]);
    if (sweep == Sweep::triangle) {
      EXPECT_TRUE(report.contacts.empty()) << "no edge meets the cell";
      EXPECT_NEAR(lowest, 0.4, 1e-9);
      // Faces cannot be swept from there on: the cell sticks through.
      options.sweep.sweep = Sweep::faces;
      EXPECT_THROW(body.step(shifted<3>(body, {0, 0, 0.01}), options, report, counts), Error);
      continue;
    }
    ASSERT_FALSE(report.contacts.empty());
    EXPECT_EQ(report.contacts[0].body, Body_feature::face);
    EXPECT_EQ(report.contacts[0].feature, 0u);
    EXPECT_EQ(report.contacts[0].point[2], 1);
    EXPECT_GT(counts.faces.faces, 50u);
    EXPECT_GT(lowest, 0.4);
    // Two corners may go down past the cell, if the third is left behind; but not the middle.
    EXPECT_GT((body.positions()[0][2] + body.positions()[1][2] + body.positions()[2][2]) / 3, 0.9);
  }
}

TEST(BodyStep, RefusesFacesThatWallsPierce) {
  const Snapshot<3> snapshot = rooms<3>({5, 5, 4}, {12});
  const Body_soup<3> soup{
      {{0.25, 0.25, 0.5}, {4.75, 0.25, 0.5}, {2.5, 4.75, 0.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
  try {
    Body<3>(snapshot, Locator<3>(snapshot), soup);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::outside);
    EXPECT_EQ(std::string(error.what()).find("face 0 of the body, with vertices 0 at (0.25, 0.25, 0.5)"), 0u)
        << error.what();
  }
}

/// Free moves need no contacts; the first of them is where a vertex stops.
TEST(BodyStep, FewContactsDoNotKeepVerticesFromMoving) {
  const Snapshot<2> snapshot = rooms<2>({4, 4});
  const Locator<2> locator(snapshot);
  for (const bool clearance : {false, true})
    for (const int most : {-1, 0, 1, 2}) {
      Body<2> body(snapshot, locator, {{{1.5, 1.5}}, {}, {}});
      Body_options options;
      options.clearance = clearance;
      options.most_contacts = most;
      Step_report<2> report;
      Body_counts counts;
      body.step(std::vector<Point<2>>{{2.5, 1.5}}, options, report, counts);
      EXPECT_EQ(body.positions()[0], (Point<2>{2.5, 1.5})) << most;
      EXPECT_TRUE(report.contacts.empty());
      body.step(std::vector<Point<2>>{{5, 2.5}}, options, report, counts);
      EXPECT_EQ(report.contacts.size(), 1u);
      EXPECT_NEAR(body.positions()[0][0], 4, 1e-12) << most;
      EXPECT_EQ(body.positions()[0][1] > 2.4, most > 1) << "it goes on along the wall after the first";
    }
}

TEST(BodyStep, ABodyWithoutVerticesStaysOne) {
  const Snapshot<3> snapshot = rooms<3>({2, 2, 2}, {});
  Body<3> body(snapshot, Locator<3>(snapshot), {});
  Step_report<3> report;
  Body_counts counts;
  body.step({}, {}, report, counts);
  EXPECT_TRUE(report.contacts.empty());
  EXPECT_EQ(counts.moves, 0u);
  EXPECT_NO_THROW(body.validate());
}

TEST(BodyStep, MovesOfOneVertexLeaveTheRegion) {
  // A solid cell at x from 10 to 11, y from 4 to 5.
  const Snapshot<2> snapshot = rooms<2>({20, 20}, {90});
  Body<2> body(snapshot, Locator<2>(snapshot), {{{9.5, 4.5}}, {}, {}});
  Step_report<2> report;
  Body_counts counts;
  body.step(std::vector<Point<2>>{{9.51, 4.5}}, {}, report, counts);
  ASSERT_EQ(counts.in_region, 1u);
  // The vertex goes from where it is now, not from where it was registered; out of the region, round the
  // cell.
  for (const Point<2>& target : {Point<2>{9.52, 6.5}, {11.5, 6.5}, {11.5, 4.5}})
    ASSERT_FALSE(body.move_vertex(0, target, {}, counts));
  EXPECT_NO_THROW(body.validate());
  // No region lets it go back through the cell.
  body.step(std::vector<Point<2>>{{9.51, 4.5}}, {}, report, counts);
  EXPECT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(body.positions()[0][0], 11);
  EXPECT_NO_THROW(body.validate());
}

/// A vertex between two cells is registered in one of them, and lies in the plane of a wall further on. In
/// which one changes nothing: it comes to lie on the upper side, where it is once it is displaced.
TEST(BodyStep, AVertexThatStaysInARegionStaysInItsCell) {
  Cell_soup<2> soup = square_grid(Grid_options<2>{.cells = {8, 4}});
  int walls = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const Point<2>&u = soup.points[soup.facet(f)[0]], &v = soup.points[soup.facet(f)[1]];
    if (u[1] != 2 || v[1] != 2 || u[0] + v[0] != 13) continue;  // from (6, 2) to (7, 2)
    soup.impassable[f] = 1;
    ++walls;
  }
  ASSERT_EQ(walls, 2);
  const Snapshot<2> snapshot = compile(soup);
  const Locator<2> locator(snapshot);
  for (const bool clearance : {false, true}) {
    Body<2> body(snapshot, locator, {{{1.5, 2.5}, {1.5, 2}}, {{0, 1}}, {}});
    Body_options options;
    options.clearance = clearance;
    Step_report<2> report;
    Body_counts counts;
    const Cell below = body.particles()[1].cell;
    body.step(std::vector<Point<2>>{{1.75, 2.5}, {1.5, 2}}, options, report, counts);
    EXPECT_EQ(counts.in_region, clearance ? 2u : 0u);
    body.leave_region(counts);
    EXPECT_EQ(body.particles()[1].cell, below);
    EXPECT_FALSE(body.move_vertex(1, {6.5, 2}, options, counts)) << "onto the wall";
    EXPECT_TRUE(body.move_vertex(1, {6.5, 1.5}, options, counts)) << "through it";
    EXPECT_FALSE(body.move_vertex(1, {6.5, 2.5}, options, counts)) << "off it";
    EXPECT_NO_THROW(body.validate());
  }
}

TEST(BodyStep, AVertexThatStaysMeetsNothing) {
  const Snapshot<2> snapshot = rooms<2>({2, 2}, {});
  const Body_soup<2> soup{
      {{0, 0}, {2, 0}, {1, 0}}, {{0, 1}, {1, 2}}, {}};  // along the floor, corner to corner
  Body<2> body(snapshot, Locator<2>(snapshot), soup);
  Body_counts counts;
  for (const Touch touch : {Touch::pass, Touch::stop})
    for (std::uint32_t v = 0; v < 3; ++v) {
      Body_options options;
      options.sweep.touch = touch;
      EXPECT_FALSE(body.move_vertex(v, soup.points[v], options, counts));
    }
  EXPECT_EQ(counts.edges.edges, 0u);
}

/// What a region lets pass must be free for a body without one: both do the same, to the bit.
template <int D>
void expect_sound_regions(const Snapshot<D>& snapshot, const Point<D>& high, int bodies) {
  Random random(3);
  const Locator<D> locator(snapshot);
  Body_counts counts, plain_counts;
  Body_options plain;
  plain.clearance = false;
  Step_report<D> report, plain_report;
  int partly = 0;
  for (int k = 0; k < bodies; ++k) {
    Body_soup<D> soup;
    Point<D> middle;
    for (int i = 0; i < D; ++i) middle[i] = random.real(0, high[i]);
    for (std::uint32_t v = 0; v < 4; ++v) {
      Point<D> x = middle;
      for (double& c : x) c += random.real(-0.2, 0.2);
      soup.points.push_back(x);
      for (std::uint32_t u = 0; u < v; ++u) soup.edges.push_back({u, v});
    }
    try {
      Body<D> body(snapshot, locator, soup), other = body;
      for (int step = 0; step < 12; ++step) {
        std::vector<Point<D>> targets;
        for (const Point<D>& x : body.positions()) {
          targets.push_back(x);
          for (double& c : targets.back()) c += random.real(-0.1, 0.1);
        }
        const std::uint64_t before = counts.in_region;
        report.clear();
        plain_report.clear();
        body.step(targets, {}, report, counts);
        other.step(targets, plain, plain_report, plain_counts);
        partly += counts.in_region - before > 0 && counts.in_region - before < 4;
        ASSERT_TRUE(std::ranges::equal(body.positions(), other.positions())) << k << " " << step;
        ASSERT_EQ(report.contacts.size(), plain_report.contacts.size());
      }
      body.refresh(counts);
      body.validate();
    } catch (const Error& error) {  // no room there
      ASSERT_EQ(error.code(), Error_code::outside) << error.what();
    }
  }
  EXPECT_GT(counts.in_region, 400u);
  EXPECT_GT(counts.contacts, 200u);
  EXPECT_GT(partly, 200);
  EXPECT_EQ(plain_counts.in_region, 0u);
}

TEST(BodyStep, RegionsHoldNoWalls2) { expect_sound_regions<2>(rooms<2>({6, 6}, {8, 14, 27}), {6, 6}, 400); }
TEST(BodyStep, RegionsHoldNoWalls3) {
  expect_sound_regions<3>(rooms<3>({4, 4, 4}, {21, 42, 5, 58}), {4, 4, 4}, 400);
}

TEST(BodyStep, TheShortFormsAreTheLongOnes) {
  const auto environment = Environment<3>::build(hex_grid({.cells = {3, 3, 3}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  const Body_soup<3> soup = rope({{0.5, 0.5, 0.5}, {0.5, 2.5, 0.5}}, 0.25);
  Body<3> brief(environment, soup), whole(snapshot, Locator<3>(snapshot), soup);
  std::size_t contacts = 0;
  for (int step = 0; step < 10; ++step) {
    const std::vector<Point<3>> targets = shifted(whole, {0.35, 0.1, 0.05});
    Step_report<3> report;
    Body_counts counts;
    whole.step(targets, {}, report, counts);
    const std::vector<Contact<3>> met = brief.step(targets);
    ASSERT_TRUE(std::ranges::equal(brief.positions(), whole.positions()));
    ASSERT_EQ(met.size(), report.contacts.size());
    for (std::size_t i = 0; i < met.size(); ++i) {
      EXPECT_EQ(met[i].exact_time(), report.contacts[i].exact_time());
      EXPECT_EQ(met[i].vertex, report.contacts[i].vertex);
    }
    contacts += met.size();
  }
  EXPECT_GT(contacts, 20u);
}

}  // namespace
}  // namespace cellwalk::test
