// SPDX-License-Identifier: LGPL-3.0-or-later
// Deformable bodies thrown around: nothing crosses a wall, no energy comes from nowhere, and under gravity
// they come to rest.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/deformable.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

const Shape_material materials[] = {{Shape_mode::rigid, 1, 0.5, true},
                                    {Shape_mode::rigid, 0.2, 0.5, true},
                                    {Shape_mode::linear, 0.6, 0.7, true},
                                    {Shape_mode::linear, 0.1, 1, false},
                                    {Shape_mode::quadratic, 0.3, 0.9, true}};

/// Bodies at random places where they fit, with velocities of this speed in random directions.
template <int D>
std::vector<Deformable<D>> thrown(const Snapshot<D>& snapshot, const Body_soup<D>& shape,
                                  const Shape_material& material, int count, double speed,
                                  std::uint64_t seed) {
  const Locator<D> locator(snapshot);
  Random random(seed);
  std::vector<Deformable<D>> bodies;
  for (int tries = 0; static_cast<int>(bodies.size()) < count && tries < 10000; ++tries) {
    Body_placement<D> placement;
    placement.rotation.degrees = random.real(0, 360);
    Vector<D> velocity;
    Spin<D> spin;
    const auto near = snapshot.point(static_cast<std::uint32_t>(random.below(snapshot.points().size())));
    for (int k = 0; k < D; ++k) {
      placement.position[k] = near[k] + random.real(-1, 1);
      velocity[k] = speed * random.real(-1, 1);
    }
    for (double& s : spin) s = random.real(-2, 2);
    try {
      Body<D> body(snapshot, locator, transformed(shape, placement));
      bodies.emplace_back(std::move(body), material, velocity, spin);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::outside);
    }
  }
  EXPECT_EQ(static_cast<int>(bodies.size()), count) << "no room for bodies";
  return bodies;
}

struct Seen {
  std::size_t contacts = 0, of_edges = 0;
  double most_deformed = 0;  ///< relative change of the length of an edge
};

/// Runs bodies and checks at every step that energy is bounded, and every so often that they are valid.
template <int D>
Seen run(std::vector<Deformable<D>>& bodies, const Dynamics_options<D>& conditions, int steps) {
  constexpr int steps_between_checks = 50;
  Seen seen;
  Body_counts counts;
  Step_report<D> report;
  for (Deformable<D>& d : bodies) {
    std::vector<double> lengths;
    for (const auto& [u, v] : d.body().edges())
      lengths.push_back(length(d.body().positions()[v] - d.body().positions()[u]));
    const double kinetic = d.kinetic_energy(), energy = d.energy(conditions.gravity);
    for (int s = 1; s <= steps; ++s) {
      report.clear();
      d.step(conditions, report, counts);
      seen.contacts += report.contacts.size();
      for (const auto& c : report.contacts) seen.of_edges += c.body == Body_feature::edge;
      if (conditions.gravity == Vector<D>{}) {
        EXPECT_LE(d.kinetic_energy(), kinetic * (1 + 1e-14)) << "step " << s;
      } else {
        EXPECT_LE(d.energy(conditions.gravity), energy + 1e-12 * std::abs(energy)) << "step " << s;
      }
      if (s % steps_between_checks != 0) continue;
      for (std::size_t e = 0; e < lengths.size(); ++e) {
        const auto [u, v] = d.body().edges()[e];
        const double now = length(d.body().positions()[v] - d.body().positions()[u]);
        seen.most_deformed = std::max(seen.most_deformed, std::abs(now / lengths[e] - 1));
      }
      d.body().refresh(counts);
      EXPECT_NO_THROW(d.body().validate());
    }
  }
  return seen;
}

template <int D>
void expect_energy_is_bounded(const Snapshot<D>& snapshot, const Body_soup<D>& shape, int steps) {
  std::size_t contacts = 0, of_edges = 0, free_steps = 0;
  for (const Shape_material& material : materials)
    for (const double restitution : {1.0, 0.4}) {
      auto bodies = thrown<D>(snapshot, shape, material, 4, 3, 9);
      Dynamics_options<D> conditions;
      conditions.time_step = 0.02;
      conditions.restitution = restitution;
      conditions.friction = restitution < 1 ? 0.2 : 0;
      const Seen seen = run<D>(bodies, conditions, steps);
      contacts += seen.contacts;
      of_edges += seen.of_edges;
      // Nothing is stuck in free space: a body with a velocity moves in every step in which it meets nothing.
      Body_counts counts;
      Step_report<D> met;
      for (auto& d : bodies) {
        for (int s = 0; s < 300; ++s) {
          const std::vector<Point<D>> from(d.body().positions().begin(), d.body().positions().end());
          const Vector<D> velocity = d.velocity();
          met.clear();
          d.step(conditions, met, counts);
          if (!met.contacts.empty() || length(velocity) < 1e-6) continue;
          ++free_steps;
          double moved = 0;
          for (std::size_t v = 0; v < from.size(); ++v)
            moved = std::max(moved, length(d.body().positions()[v] - from[v]));
          EXPECT_GT(moved, 0.5 * conditions.time_step * length(velocity));
        }
      }
    }
  EXPECT_GT(contacts, 500u);
  EXPECT_GT(of_edges, 20u);
  EXPECT_GT(free_steps, 1000u) << "came to rest without gravity";
}

TEST(Deformable, NeverGainsKineticEnergy2) {
  expect_energy_is_bounded<2>(rooms<2>({6, 6}, {8, 16, 27, 22}), polygon_body(6, 0.3), 1500);
}
TEST(Deformable, NeverGainsKineticEnergy3) {
  expect_energy_is_bounded<3>(rooms<3>({4, 4, 4}, {21, 42, 5, 58}), hexahedron_body(0.3, false), 1500);
}
TEST(Deformable, NeverGainsKineticEnergyInAVessel) {
  expect_energy_is_bounded<3>(test::compile(branching_vessel({})), icosphere_body(0.4, 1), 100);
}

template <int D>
void expect_bodies_come_to_rest(const Snapshot<D>& snapshot, const Body_soup<D>& shape) {
  for (const Shape_material& material : materials) {
    if (material.deformation == 1) continue;  // nothing resists stretching and shearing: it flows
    auto bodies = thrown<D>(snapshot, shape, material, 4, 2, 5);
    Dynamics_options<D> conditions;
    conditions.time_step = 0.01;
    conditions.restitution = 0.5;
    conditions.friction = 0.2;
    conditions.gravity[D - 1] = -9.81;
    const Seen seen = run<D>(bodies, conditions, 2500);
    EXPECT_GT(seen.contacts, 2000u);
    Body_counts counts;
    Step_report<D> met;
    for (auto& d : bodies) {
      const std::vector<Point<D>> before(d.body().positions().begin(), d.body().positions().end());
      for (int s = 0; s < 200; ++s) d.step(conditions, met, counts);
      for (std::size_t v = 0; v < before.size(); ++v)
        EXPECT_LT(length(d.body().positions()[v] - before[v]), 0.02) << "jitters or slides";
      EXPECT_LT(d.kinetic_energy(), 1e-3);
      double lowest = 1e9;
      for (const Point<D>& x : d.body().positions()) lowest = std::min(lowest, x[D - 1]);
      EXPECT_NEAR(lowest, std::round(lowest), 1e-9) << "lies on the floor or on a solid cell";
    }
  }
}

TEST(Deformable, ComesToRestOnTheFloor2) {
  expect_bodies_come_to_rest<2>(rooms<2>({6, 6}, {8, 27}), polygon_body(6, 0.3));
}
TEST(Deformable, ComesToRestOnTheFloor3) {
  expect_bodies_come_to_rest<3>(rooms<3>({3, 3, 3}, {13}), hexahedron_body(0.3, false));
}

TEST(Deformable, FliesStraightAndTurnsEvenly) {
  const Snapshot<3> snapshot = rooms<3>({20, 20, 20});
  for (const Shape_material& material : materials) {
    const Locator<3> locator(snapshot);
    Body_placement<3> placement;
    placement.position = {2, 10, 10};
    Deformable<3> d(Body<3>(snapshot, locator, transformed(hexahedron_body(1, false), placement)), material,
                    {1, 0.5, 0.25}, {0, 0, std::numbers::pi / 2});
    Dynamics_options<3> conditions;
    conditions.time_step = 0.01;
    Step_report<3> report;
    Body_counts counts;
    const double energy = d.kinetic_energy();
    for (int s = 0; s < 800; ++s) d.step(conditions, report, counts);
    EXPECT_TRUE(report.contacts.empty());
    EXPECT_NEAR(d.kinetic_energy(), energy, 1e-9 * energy);
    Point<3> middle{};
    for (const Point<3>& x : d.body().positions()) middle = middle + 0.125 * x;
    EXPECT_LT(length(middle - Point<3>{10, 14, 12}), 1e-9);
    // Two full turns.
    EXPECT_LT(length(d.body().positions()[0] - Point<3>{9.5, 13.5, 11.5}), 1e-9);
  }
}

TEST(Deformable, BouncesWithItsRestitution) {
  const Snapshot<3> snapshot = rooms<3>({4, 4, 4});
  const Locator<3> locator(snapshot);
  for (const double restitution : {0.0, 0.5, 1.0}) {
    Body_placement<3> placement;
    placement.position = {2, 2, 2};
    Deformable<3> d(Body<3>(snapshot, locator, transformed(hexahedron_body(0.5, false), placement)), {},
                    {0, 0, -1}, {});
    Dynamics_options<3> conditions;
    conditions.time_step = 0.02;
    conditions.restitution = restitution;
    Step_report<3> report;
    Body_counts counts;
    for (int s = 0; s < 110; ++s) d.step(conditions, report, counts);
    EXPECT_GE(report.contacts.size(), 4u);
    EXPECT_NEAR(d.velocity()[2], restitution, 1e-9) << "flat on the floor: all corners at once";
    EXPECT_NEAR(d.kinetic_energy(), 4 * restitution * restitution, 1e-9);
  }
}

TEST(Deformable, FrictionSlowsItDown) {
  const Snapshot<2> snapshot = rooms<2>({8, 2});
  const Locator<2> locator(snapshot);
  double before = 10;
  for (const double friction : {0.0, 0.1, 1.0}) {
    Body_placement<2> placement;
    placement.position = {1, 0.5};
    Deformable<2> d(Body<2>(snapshot, locator, transformed(quad_body(0.5), placement)), {}, {1, 0}, {});
    Dynamics_options<2> conditions;
    conditions.restitution = 0.3;
    conditions.friction = friction;
    conditions.gravity = {0, -9.81};
    Step_report<2> report;
    Body_counts counts;
    for (int s = 0; s < 300; ++s) d.step(conditions, report, counts);
    const double reached = d.body().positions()[0][0];
    EXPECT_LT(reached, before - 0.05);
    // Part of the energy is spent when the landing body finds back to its shape.
    if (friction == 0) {
      EXPECT_NEAR(d.velocity()[0], 0.9, 0.1);
    }
    if (friction == 1) {
      EXPECT_NEAR(d.velocity()[0], 0, 1e-6);
    }
    before = reached;
  }
}

TEST(Deformable, SoftBodiesAreDeformedByWalls) {
  const Snapshot<3> snapshot = rooms<3>({3, 3, 3});
  const Body_soup<3> shape = icosphere_body(0.4, 1);
  Dynamics_options<3> conditions;
  conditions.time_step = 0.01;
  conditions.gravity = {0, 0, -9.81};
  conditions.restitution = 0.5;
  double before = 0;
  for (const double stiffness : {1.0, 0.3, 0.05}) {
    auto bodies = thrown<3>(snapshot, shape, {Shape_mode::quadratic, stiffness, 0.8, true}, 3, 1, 4);
    const double deformed = run<3>(bodies, conditions, 400).most_deformed;
    EXPECT_GT(deformed, before);
    before = deformed;
  }
  EXPECT_GT(before, 0.1);
}

TEST(Deformable, IsRefusedAndStaysWhereItIsIfItsMotionIsNotFinite) {
  const Snapshot<2> snapshot = rooms<2>({3, 3});
  const Locator<2> locator(snapshot);
  Body_placement<2> placement;
  placement.position = {1.5, 1.5};
  for (const double huge : {1e200, 1e308}) {
    Deformable<2> d(Body<2>(snapshot, locator, transformed(quad_body(0.5), placement)), {}, {1, 0}, {});
    Dynamics_options<2> conditions;
    conditions.gravity = {huge, huge};
    conditions.time_step = 1e150;
    Step_report<2> report;
    Body_counts counts;
    const std::vector<Point<2>> before(d.body().positions().begin(), d.body().positions().end());
    EXPECT_THROW(d.step(conditions, report, counts), Error);
    EXPECT_TRUE(std::ranges::equal(before, d.body().positions()));
  }
}

TEST(Deformable, BodiesOfOneVertexOrOneEdgeFlyToo) {
  const Snapshot<3> snapshot = rooms<3>({3, 3, 3}, {13});
  std::size_t contacts = 0;
  for (const Body_soup<3>& shape :
       {polyline_body<3>({{0, 0, 0}}), catheter_body<3>(0.4, 2), catheter_body<3>(0.6, 5)}) {
    auto bodies = thrown<3>(snapshot, shape, {Shape_mode::linear, 0.5, 0.5, true}, 3, 3, 6);
    Dynamics_options<3> conditions;
    conditions.time_step = 0.02;
    contacts += run<3>(bodies, conditions, 1000).contacts;
  }
  EXPECT_GT(contacts, 100u);
}

TEST(Deformable, GivesTheSameBitsWithEveryCompiler) {
  const Snapshot<3> snapshot = rooms<3>({4, 4, 4}, {21, 42});
  std::uint64_t h = 0;
  std::size_t contacts = 0;
  for (const Shape_material& material : materials) {
    auto bodies = thrown<3>(snapshot, hexahedron_body(0.3, false), material, 3, 3, 8);
    Dynamics_options<3> conditions;
    conditions.time_step = 0.02;
    conditions.gravity = {0, 0, -3};
    conditions.restitution = 0.8;
    conditions.friction = 0.05;
    contacts += run<3>(bodies, conditions, 150).contacts;
    for (const auto& d : bodies)
      for (const Point<3>& x : d.body().positions())
        for (const double c : x) h = scramble(h ^ std::bit_cast<std::uint64_t>(c));
  }
  EXPECT_GT(contacts, 200u);
  EXPECT_EQ(h, 6916467609962309061u);
}

}  // namespace
}  // namespace cellwalk
