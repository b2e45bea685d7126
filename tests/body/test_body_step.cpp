// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps of bodies by hand: where they stop, what they report, and how they go on.
#include <cellwalk/body/body.h>
#include <cellwalk/body/generate.h>
#include <cellwalk/body/transform.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/random.h>

#include <gtest/gtest.h>

#include <cmath>
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
  return Body<3>(snapshot, Locator<3>(snapshot),
                 transformed(generate_body(Hexahedron_shape{side, false}), placement));
}

TEST(Body_step, SlidesAlongAnAxisAlignedWall) {
  const Snapshot<3> snapshot = room<3>({8, 4, 4}, {});
  Body<3> body = hexahedron(snapshot, {2, 2, 0.5}, 1);  // stands on the floor
  std::vector<Body_contact<3>> contacts;
  Body_counts counts;
  for (int k = 0; k < 40; ++k) {
    body.step(shifted<3>(body, {0.1, 0, -0.05}), {}, contacts, counts);  // pressed down and pulled along
    body.catch_up(counts);
    ASSERT_NO_THROW(body.validate());
  }
  EXPECT_GT(body.positions()[0][0], 5.4) << "it stuck to the floor";
  EXPECT_LT(body.positions()[0][2], 1e-9);
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts[0].contact.normal, (Vector<3>{0, 0, 1}));
}

TEST(Body_step, SlidesAlongAnObliqueWall) {
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
  Body<2> body(snapshot, Locator<2>(snapshot), transformed(generate_body(Quad_shape{0.5}), placement));
  std::vector<Body_contact<2>> contacts;
  Body_counts counts;
  for (int k = 0; k < 160; ++k) {
    body.step(shifted<2>(body, {0.07, -0.02}), {}, contacts, counts);
    body.catch_up(counts);
    ASSERT_NO_THROW(body.validate());
  }
  EXPECT_GT(body.positions()[0][0], 8) << "it stuck to the wall";
  EXPECT_GT(contacts.size(), 20u);
  EXPECT_LT(counts.held, contacts.size() / 2);
}

TEST(Body_step, ReportsTheEdgeThatMeetsASpike) {
  // A solid cell sticks out of the floor; an edge longer than it is wide comes down on it.
  const Snapshot<3> snapshot = room<3>({5, 3, 4}, {7});
  const Body_soup<3> soup{{{0.5, 1.25, 2.5}, {4.5, 1.25, 2.5}}, {{0, 1}}, {}};
  Body<3> body(snapshot, Locator<3>(snapshot), soup);
  Body_counts counts;
  const auto contact = body.move_vertex(0, {0.5, 1.25, 0.05}, {}, counts);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->contact.body, Body_feature::edge);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_EQ(contact->vertex, 0u);
  EXPECT_EQ(contact->contact.kind, Contact_kind::edge);
  // The edge meets (2, 1.25, 1): on a line with (4.5, 1.25, 2.5), p is then at height 0.1.
  EXPECT_NEAR(contact->contact.time, 2.4 / 2.45, 1e-12);
  EXPECT_EQ(contact->contact.point[1], 1.25);
  EXPECT_EQ(body.positions()[0], (Point<3>{0.5, 1.25, 2.5})) << "nothing moves where there is a contact";
}

/// Whatever a clearance lets pass must be free for a body without one.
template <int D>
void expect_sound_regions(const Snapshot<D>& snapshot, const Point<D>& high, int bodies) {
  Random random(3);
  const Locator<D> locator(snapshot);
  Body_counts counts, plain_counts;
  Body_options plain;
  plain.clearance = false;
  std::vector<Body_contact<D>> contacts;
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
        const std::uint64_t before = counts.in_region;
        std::vector<Point<D>> targets;
        for (const Point<D>& x : body.positions()) {
          targets.push_back(x);
          for (double& c : targets.back()) c += random.real(-0.1, 0.1);
        }
        contacts.clear();
        body.step(targets, {}, contacts, counts);
        if (counts.in_region == before) {
          other = body;
          other.leave_region(counts);
          continue;
        }
        other.step(targets, plain, contacts, plain_counts);
        EXPECT_TRUE(contacts.empty()) << "a region let a contact pass";
      }
    } catch (const Error&) {  // no room there
    }
  }
  EXPECT_GT(counts.in_region, 400u);
  EXPECT_GT(counts.no_region, 50u);
}

TEST(Body_step, RegionsHoldNoWalls2) { expect_sound_regions<2>(room<2>({6, 6}, {8, 14, 27}), {6, 6}, 400); }
TEST(Body_step, RegionsHoldNoWalls3) {
  expect_sound_regions<3>(room<3>({4, 4, 4}, {21, 42, 5, 58}), {4, 4, 4}, 400);
}

}  // namespace
}  // namespace cellwalk::test
