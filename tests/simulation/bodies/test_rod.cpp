// SPDX-License-Identifier: LGPL-3.0-or-later
// Catheters: the shape of a rod in free space, and what walls make of it.
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/world.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

template <int D>
Scene<D> catheter_scene(std::vector<Point<D>> path, double spacing, double advance, std::uint32_t particles) {
  Scene<D> scene;
  Catheter<D> catheter;
  catheter.path = std::move(path);
  catheter.spacing = spacing;
  catheter.advance = advance;
  catheter.particles = particles;
  scene.catheter = catheter;
  return scene;
}

/// What was seen of a catheter that was pushed for some steps; it was valid after each of them.
struct Pushed {
  std::size_t contacts = 0, of_edges = 0;
  double longest_link = 0;  ///< in spacings
};

template <int D>
Pushed push(World<D>& world, int steps, double spacing) {
  Pushed pushed;
  for (int i = 0; i < steps; ++i) {
    world.step();
    world.validate();
    pushed.contacts += world.contacts().size();
    for (const auto& c : world.contacts()) {
      EXPECT_EQ(c.body, 0u);
      pushed.of_edges += c.contact.body == Body_feature::edge;
    }
    const auto x = world.catheter()->body().positions();
    for (std::size_t k = 0; k + 1 < x.size(); ++k)
      pushed.longest_link = std::max(pushed.longest_link, length(x[k] - x[k + 1]) / spacing);
  }
  return pushed;
}

TEST(Rod, GoesStraightInFreeSpace) {
  const auto snapshot = rooms<3>({8, 8, 8});
  for (const double stiffness : {0.0, 0.5, 1.0})
    for (const Steering steering : {Steering::tip, Steering::none}) {
      auto scene = catheter_scene<3>({{1, 1, 1}, {6, 4, 3}}, 0.25, 0.1, 20);
      scene.catheter->stiffness = stiffness;
      scene.catheter->steering = steering;
      World<3> world(snapshot, scene);
      EXPECT_EQ(push(world, 33, 0.25).contacts, 0u);
      const Rod<3>& rod = *world.catheter();
      EXPECT_NEAR(rod.length_inside(), 3.3, 1e-12);
      const Vector<3> direction = (1 / length(Vector<3>{5, 3, 2})) * Vector<3>{5, 3, 2};
      const auto x = rod.body().positions();
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double inside = std::max(0.0, 3.3 - 0.25 * static_cast<double>(i));
        EXPECT_LT(length(x[i] - (Point<3>{1, 1, 1} + inside * direction)), 1e-9) << i;
      }
      EXPECT_EQ(rod.steps_waited(), 0u);
    }
}

/// The direction of the end of a rod.
template <int D>
Vector<D> end_of(const Rod<D>& rod) {
  const Vector<D> v = rod.body().positions()[0] - rod.body().positions()[1];
  return (1 / length(v)) * v;
}

TEST(Rod, TheTipIsCurvedAndTurnsWithTheBase) {
  const auto snapshot = rooms<3>({20, 20, 20});
  std::vector<Vector<3>> ends;
  for (const double twist : {0.0, 0.9, 1.8, 3.6}) {
    auto scene = catheter_scene<3>({{10, 10, 2}, {10, 10, 9}}, 0.25, 0.1, 25);
    scene.catheter->steering = Steering::none;
    scene.catheter->stiffness = 1;
    scene.catheter->tip_length = 2;
    scene.catheter->tip_angle = 60;
    scene.catheter->twist = twist;
    World<3> world(snapshot, scene);
    push(world, 100, 0.25);
    EXPECT_NEAR(world.catheter()->twist(), 100 * twist, 1e-9);
    ends.push_back(end_of(*world.catheter()));
    EXPECT_NEAR(std::acos(ends.back()[2]) * 180 / std::numbers::pi, 60, 8);
  }
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double turned = std::atan2(ends[0][0] * ends[i][1] - ends[0][1] * ends[i][0],
                                     ends[0][0] * ends[i][0] + ends[0][1] * ends[i][1]) *
                          180 / std::numbers::pi;
    const double expected[] = {0, 90, 180, 360};
    EXPECT_NEAR(std::remainder(turned - expected[i], 360), 0, 12);
  }
}

TEST(Rod, InThePlaneATurnedTipLooksTheOtherWay) {
  const auto snapshot = rooms<2>({20, 20});
  for (const double twist : {0.0, 1.8}) {
    auto scene = catheter_scene<2>({{2, 10}, {9, 10}}, 0.25, 0.1, 25);
    scene.catheter->steering = Steering::none;
    scene.catheter->stiffness = 1;
    scene.catheter->tip_length = 2;
    scene.catheter->tip_angle = 60;
    scene.catheter->twist = twist;
    World<2> world(snapshot, scene);
    push(world, 100, 0.25);
    EXPECT_NEAR(end_of(*world.catheter())[1], twist == 0 ? std::sqrt(0.75) : -std::sqrt(0.75), 0.1);
  }
}

TEST(Rod, BendsLessTheStifferItIs) {
  const auto snapshot = rooms<2>({20, 20});
  double before = 1e9;
  for (const double stiffness : {0.0, 0.1, 1.0}) {
    auto scene = catheter_scene<2>({{2, 2}, {8, 2}, {8, 9}}, 0.25, 0.1, 80);
    scene.catheter->stiffness = stiffness;
    World<2> world(snapshot, scene);
    EXPECT_EQ(push(world, 100, 0.25).contacts, 0u);
    EXPECT_EQ(world.catheter()->next_waypoint(), 2u) << "round the bend";
    double sharpest = 0;
    const auto x = world.catheter()->body().positions();
    for (std::size_t i = 1; x[i + 1] != x[i + 2]; ++i)
      sharpest = std::max(sharpest, length(0.5 * (x[i - 1] + x[i + 1]) - x[i]));
    EXPECT_LT(sharpest, 0.9 * before);
    before = sharpest;
  }
}

/// A corridor with two bends: 5 x 5 cells, solid but for an S.
const std::vector<std::uint32_t> corridor{5, 6, 7, 8, 16, 17, 18, 19};

TEST(Rod, FindsItsWayRoundBends) {
  const auto snapshot = rooms<2>({5, 5}, corridor);
  for (const double stiffness : {0.0, 0.5, 1.0}) {
    auto scene = catheter_scene<2>({{0.5, 0.5}, {0.5, 4.5}}, 0.25, 0.1, 60);
    scene.catheter->find_route = true;
    scene.catheter->stiffness = stiffness;
    World<2> world(snapshot, scene);
    const Pushed pushed = push(world, 250, 0.25);
    EXPECT_GT(pushed.of_edges, 50u) << stiffness;
    EXPECT_LT(pushed.longest_link, 2) << stiffness;
    const Rod<2>& rod = *world.catheter();
    EXPECT_TRUE(rod.has_arrived()) << stiffness;
    EXPECT_LT(length(rod.tip() - Point<2>{0.5, 4.5}), 0.25) << stiffness;
    EXPECT_GT(rod.length_inside(), 8);
    // No edge goes through a solid cell, by doubles that know nothing of chains.
    const auto x = rod.body().positions();
    for (const auto& [u, v] : rod.body().edges())
      for (const std::uint32_t cell : corridor)
        EXPECT_FALSE(test::pierces<2>(x[u], x[v], {cell % 5 * 1.0, cell / 5 * 1.0}, 1e-9));
  }
}

TEST(Rod, EndsAtTheWallThatItIsPushedAgainst) {
  const auto snapshot = rooms<3>({4, 2, 2});
  for (const Steering steering : {Steering::tip, Steering::none}) {
    auto scene = catheter_scene<3>({{0.2, 1.1, 0.9}, {9, 1.1, 0.9}}, 0.3, 0.15, 40);
    scene.catheter->steering = steering;
    World<3> world(snapshot, scene);
    EXPECT_GT(push(world, 80, 0.3).contacts, 20u);
    const Rod<3>& rod = *world.catheter();
    EXPECT_NEAR(rod.tip()[0], 4, 1e-9);
    EXPECT_FALSE(rod.has_arrived());
    EXPECT_GT(rod.steps_waited(), 20u);
    EXPECT_LT(rod.length_inside(), 3.8 + 0.3 + 0.15 + 1e-9) << "held back";
  }
}

TEST(Rod, IsNoLongerThanItIs) {
  const auto snapshot = rooms<3>({8, 2, 2});
  auto scene = catheter_scene<3>({{0.2, 1.1, 0.9}, {7, 1.1, 0.9}}, 0.3, 0.15, 8);
  World<3> world(snapshot, scene);
  push(world, 60, 0.3);
  EXPECT_NEAR(world.catheter()->tip()[0], 0.2 + 7 * 0.3, 1e-9);
  EXPECT_NEAR(world.catheter()->length_inside(), 7 * 0.3, 1e-12);
}

/// Into one of two branches: the tubes through which the way goes, and half of the last one.
Scene<3> in_a_vessel(Steering steering, const std::vector<std::size_t>& branches) {
  const std::vector<Tube> tubes = vessel_tubes({});
  std::vector<Point<3>> path{{0, 0, 0.2}};
  for (const std::size_t branch : branches) {
    const auto& points = tubes[branch].points;
    path.push_back(points[points.size() / 2]);
    if (branch != branches.back()) path.push_back(points.back());
  }
  auto scene = catheter_scene<3>(path, 0.2, 0.08, 110);
  scene.catheter->stiffness = 0.9;
  scene.catheter->steering = steering;
  if (steering == Steering::twist) {
    scene.catheter->tip_length = 1.4;
    scene.catheter->tip_angle = 50;
    scene.catheter->twist = 10;
  }
  return scene;
}

TEST(Rod, FindsABranchOfAVessel) {
  const auto snapshot = test::compile(branching_vessel({}));
  for (const std::vector<std::size_t>& branches : {std::vector<std::size_t>{0, 2, 5, 11}, {0, 1, 4, 10}}) {
    for (const Steering steering : {Steering::tip, Steering::twist}) {
      World<3> world(snapshot, in_a_vessel(steering, branches));
      const Pushed pushed = push(world, 260, 0.2);
      EXPECT_TRUE(world.catheter()->has_arrived()) << "branch " << branches.back();
      EXPECT_LT(pushed.longest_link, 1.8);
      if (steering == Steering::tip) continue;  // along the middle of the vessel
      EXPECT_GT(pushed.contacts, 200u);
      EXPECT_GT(pushed.of_edges, 100u);
    }
    // Without steering it ends elsewhere.
    World<3> world(snapshot, in_a_vessel(Steering::none, branches));
    EXPECT_GT(push(world, 260, 0.2).contacts, 100u);
    EXPECT_FALSE(world.catheter()->has_arrived());
  }
}

TEST(Rod, OfOneLinkOrOfOneVertexWorksToo) {
  const auto snapshot = rooms<2>({3, 3});
  for (const std::uint32_t particles : {1u, 2u}) {
    World<2> world(snapshot, catheter_scene<2>({{1, 1}, {2, 2}}, 0.5, 0.2, particles));
    EXPECT_EQ(push(world, 20, 0.5).contacts, 0u);
    EXPECT_NEAR(length(world.catheter()->tip() - Point<2>{1, 1}), particles == 1 ? 0 : 0.5, 1e-12);
  }
}

TEST(Rod, GivesTheSameBitsWithEveryCompiler) {
  const auto snapshot = rooms<2>({5, 5}, corridor);
  auto scene = catheter_scene<2>({{0.5, 0.5}, {0.5, 4.5}}, 0.25, 0.1, 60);
  scene.catheter->find_route = true;
  World<2> world(snapshot, scene);
  EXPECT_GT(push(world, 150, 0.25).contacts, 20u);
  std::uint64_t h = 0;
  for (const Point<2>& x : world.catheter()->body().positions())
    for (const double c : x) h = scramble(h ^ std::bit_cast<std::uint64_t>(c));
  EXPECT_EQ(h, 7433184513892670874u);
}

}  // namespace
}  // namespace cellwalk
