// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene of the paper in small: deformable hexahedra bounce in a grid with a tenth of its cells solid.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/world.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "simulation/worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

Scene<3> hexahedra(std::uint32_t count, const Shape_material& material) {
  Scene<3> scene;
  Body_start<3> start;
  start.source = Hexahedron_shape{0.3, false};
  start.cloud = Particle_cloud{count, 3, 7};
  start.spin = {0.5, 0.3, 0.2};
  start.material = material;
  scene.bodies.push_back(start);
  scene.time_step = 0.02;
  return scene;
}

Snapshot<3> grid() {
  Grid_options<3> options;
  options.cells = {10, 10, 10};
  options.solid_share = 0.1;
  return test::compile(hex_grid(options));
}

/// 225 bodies, fewer under a sanitizer; valid at every twentieth step.
void expect_hexahedra_bounce(const Shape_material& material, int steps) {
  const auto snapshot = grid();
  const auto bodies = static_cast<std::uint32_t>(std::min<std::size_t>(225, oracle::scaled_count(225)));
  World<3> world(snapshot, hexahedra(bodies, material), {hexahedron_body(0.3, false)});
  ASSERT_EQ(world.bodies().size(), bodies);
  std::vector<double> energy;
  for (const auto& body : world.bodies()) {
    ASSERT_TRUE(body.as<Deformable<3>>());
    energy.push_back(body.as<Deformable<3>>()->kinetic_energy());
  }
  std::size_t by_vertex = 0, by_edge = 0;
  for (int i = 0; i < steps; ++i) {
    world.step();
    for (const auto& c : world.contacts()) ++(c.contact.body == Body_feature::vertex ? by_vertex : by_edge);
    for (std::size_t b = 0; b < energy.size(); ++b)
      EXPECT_LE(world.bodies()[b].as<Deformable<3>>()->kinetic_energy(), energy[b] * (1 + 1e-14));
    if (i % 20 == 0) world.validate();
  }
  world.validate();
  EXPECT_GT(by_vertex, bodies);
  EXPECT_GT(by_edge, bodies / 3);
}

TEST(WorldDeformable, RigidHexahedraBounce) {
  expect_hexahedra_bounce({Shape_mode::rigid, 1, 0.5, true}, 250);
}
TEST(WorldDeformable, LinearHexahedraBounce) {
  expect_hexahedra_bounce({Shape_mode::linear, 1, 0.5, true}, 1000);
}
TEST(WorldDeformable, QuadraticHexahedraBounce) {
  expect_hexahedra_bounce({Shape_mode::quadratic, 0.3, 0.8, true}, 250);
}

/// Bodies do not see each other: each does alone what it does among others.
TEST(WorldDeformable, BodiesAreIndependent) {
  const auto snapshot = grid();
  const Body_soup<3> shape = hexahedron_body(0.3, false);
  World<3> together(snapshot, hexahedra(6, {Shape_mode::linear, 0.5, 0.8, true}), {shape});
  std::vector<Moving_body<3>> alone(together.bodies().begin(), together.bodies().end());
  for (int i = 0; i < 100; ++i) together.step();
  Dynamics_options<3> conditions;
  conditions.time_step = 0.02;
  Body_counts counts;
  Step_report<3> report;
  for (std::size_t b = alone.size(); b-- > 0;) {
    for (int i = 0; i < 100; ++i) alone[b].step(conditions, report, counts);
    EXPECT_TRUE(std::ranges::equal(alone[b].body().positions(), together.bodies()[b].body().positions()));
  }
  EXPECT_GT(report.contacts.size(), 10u);
}

}  // namespace
}  // namespace cellwalk
