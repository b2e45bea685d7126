// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies with a radius in worlds that a hunt for counterexamples found: each was answered wrongly once.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/environment/gluing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

#include "oracle/squares_and_cubes.h"

namespace cellwalk::test {
namespace {

void add_polygon(Cell_soup<2>& soup, std::initializer_list<std::uint32_t> loop) {
  for (auto v = loop.begin(); v != loop.end(); ++v)
    soup.add_facet({*v, v + 1 == loop.end() ? *loop.begin() : v[1]});
  soup.end_cell();
}

// The vertex stays in the region of the body, its edge does not.
TEST(HuntedThickBodies, AnEdgeLeavesTheRegionByTheRuleOfThePaper) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {8, 4}, {8, 8}, {4, 8}, {0, 8}};
  add_polygon(soup, {0, 1, 2, 3});
  add_polygon(soup, {3, 2, 6, 7});
  add_polygon(soup, {2, 4, 5, 6});
  const auto room = Environment<2>::build(soup);
  for (const bool clearance : {true, false}) {
    Body<2> body(room,
                 {{{2.71032, 2.5359}, {4.10174, 6.82739}, {5.36326, 4.52965}}, {{0, 1}, {1, 2}}, {}, {0.3}});
    Body_options options;
    options.rule = Step_rule::reject_at_target;
    options.clearance = clearance;
    Body_counts counts;
    Step_report<2> report;
    const std::vector<Point<2>> targets{{3.55441, 2.99393}, {4.55498, 7.30283}, {5.52139, 4.54026}};
    body.step(targets, options, report, counts);
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
    EXPECT_EQ(body.positions()[0], (Point<2>{2.71032, 2.5359}));
    EXPECT_EQ(report.contacts.size(), 1u);
  }
}

// A wall of another room has a vertex where the wall of this one is met in its interior.
TEST(HuntedThickBodies, WallsOfAnotherRoomAreNotNamed) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0.5}, {2, 0}, {2, 0.5}, {2, 1}, {1, 0}, {1, 1}};
  add_polygon(soup, {0, 1, 2, 3});
  add_polygon(soup, {8, 5, 6, 4});
  add_polygon(soup, {4, 6, 7, 9});
  const auto snapshot = Snapshot<2>::compile(soup, glue(soup));
  Body<2> body(snapshot, Locator<2>(snapshot), {{{0.5, 0.5}}, {}, {}, {0.25}});
  Body_options options;
  options.rule = Step_rule::reject;
  Body_counts counts;
  Step_report<2> report;
  body.step(std::vector<Point<2>>{{0.9, 0.5}}, options, report, counts);
  Edge_counts uncounted;
  const auto by_flood =
      detail::sweep_thick<2>(snapshot, snapshot.cell(0), {{0.5, 0.5}, {0.9, 0.5}, {}, 0.25}, uncounted)
          .contact;
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts[0].kind, Contact_kind::facet);
  EXPECT_EQ(report.contacts[0].facet, by_flood->facet);
}

// The squares of normals underflow.
TEST(HuntedThickBodies, RegionsOfTinyWorldsMoveInwards) {
  for (const int exponent : {-200, -270, -280, -300, -320}) {
    const double u = std::ldexp(1, exponent);
    Cell_soup<3> soup;
    soup.points = {{0, 0, 0}, {8 * u, 0, 0}, {0, 8 * u, 0}, {0, 0, 8 * u}};
    add_tetrahedron(soup, 0, 1, 2, 3);
    const auto room = Environment<3>::build(soup);
    Body<3> body(room, {{{2 * u, 2 * u, 2 * u}, {1.5 * u, 1.5 * u, 1.5 * u}}, {{0, 1}}, {}, {0.25 * u}});
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    Body_counts counts;
    for (int step = 0; step < 50; ++step) {
      std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
      for (Point<3>& x : targets) x = x + u * Vector<3>{shift(generator), shift(generator), shift(generator)};
      Step_report<3> report;
      body.step(targets, {}, report, counts);
      Body<3> refreshed = body;
      refreshed.refresh(counts);
      ASSERT_NO_THROW(refreshed.validate()) << "at 2^" << exponent;
    }
  }
}

/// A star of nine vertices, whose last one has a group of its own with a face only, above or below membranes
/// with a rim.
class StarWithAFace : public testing::Test {
 protected:
  static constexpr std::uint32_t size = 12;
  StarWithAFace() {
    Cell_soup<3> soup = oracle::make_cubes(size, size, size);
    const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      return x + size * (y + size * z);
    };
    for (std::uint32_t x = 0; x < size; ++x)
      for (std::uint32_t y = 0; y < 6; ++y) oracle::set_wall(soup, at(x, y, 5), at(x, y, 6));
    for (std::uint32_t y = 0; y < 6; ++y) oracle::set_wall(soup, at(5, y, 6), at(6, y, 6));
    snapshot = Snapshot<3>::compile(soup, glue(soup));
    star.points = {{5.5, 5.1, 5.8}, {5.5, 4.7, 5.8}};
    for (int i = 2; i < 8; ++i) star.points.push_back({5.4, 5.0 + 0.02 * i, 5.8});
    star.points.push_back({5.75, 4.9, 5.8});
    for (std::uint32_t i = 1; i <= 8; ++i) star.edges.push_back({0, i});
    star.edges.push_back({1, 8});
    star.faces = {{8, 0, 1}};
    star.radii = {0.1};
    options.clearance = false;
  }
  Step_report<3> moved(Body<3>& body, const std::vector<Point<3>>& targets) const {
    Step_report<3> report;
    Body_counts counts;
    body.step(targets, options, report, counts);
    return report;
  }
  void move_all(Body<3>& body, const Vector<3>& by) const {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (Point<3>& x : targets) x = x + by;
    EXPECT_TRUE(moved(body, targets).contacts.empty());
  }

  Snapshot<3> snapshot;
  Body_soup<3> star;
  Body_options options;
};

// The list of the face was made before faces were left alone, on the other side of the membrane.
TEST_F(StarWithAFace, ListsOfFacesLocateNoWay) {
  const Locator<3> locator(snapshot);
  Body<3> body(snapshot, locator, star);
  options.sweep.sweep = Sweep::faces;
  move_all(body, {0, 0.1, 0});
  options.sweep.sweep = Sweep::triangle;
  move_all(body, {0, 2.5, 0});
  move_all(body, {0, 0, 0.38});
  move_all(body, {0, -2.5, 0});
  std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
  targets[8][1] = 5;
  moved(body, targets);
  Body_soup<3> now = star;
  now.points.assign(body.positions().begin(), body.positions().end());
  Body<3> fresh(snapshot, locator, now);
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = true;
  targets.assign(body.positions().begin(), body.positions().end());
  targets[8] = targets[8] + Vector<3>{0.2, 0, -0.1};
  const auto blocked = moved(body, targets).blocked, expected = moved(fresh, targets).blocked;
  ASSERT_EQ(blocked.size(), 1u);
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_EQ(blocked[0].contact->time, expected[0].contact->time);
  EXPECT_EQ(blocked[0].contact->facet, expected[0].contact->facet);
}

}  // namespace
}  // namespace cellwalk::test
