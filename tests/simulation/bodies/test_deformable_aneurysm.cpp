// SPDX-License-Identifier: LGPL-3.0-or-later
// Deformable bodies and a catheter in a real vessel.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include <iostream>

namespace cellwalk {
namespace {

const Environment<3>& aneurysm() {
  static const Environment<3> environment =
      Environment<3>::build(tetrahedralize(io::read_surface(CELLWALK_TEST_DATA "/surface/aneurysm3D_1.off")));
  return environment;
}

/// The middle of the cell that is furthest in a direction.
Point<3> end_of(const Snapshot<3>& snapshot, const Vector<3>& direction) {
  Point<3> best{};
  double most = -1e300;
  for (std::uint32_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell_view<3> cell = snapshot.view(snapshot.cell(i));
    Point<3> middle{};
    for (std::size_t k = 0; k < cell.vertex_count(); ++k) middle = middle + cell.point(k);
    middle = (1 / static_cast<double>(cell.vertex_count())) * middle;
    if (dot(middle, direction) > most) most = dot(middle, direction), best = middle;
  }
  return best;
}

TEST(DeformableInAnAneurysm, KeepsItsInvariants) {
  const Snapshot<3>& snapshot = aneurysm().snapshot();
  Scene<3> scene;
  scene.time_step = 0.05;
  scene.restitution = 0.9;
  for (const Shape_material& material : {Shape_material{Shape_mode::linear, 1, 0.5, true},
                                         Shape_material{Shape_mode::quadratic, 0.3, 0.8, true}}) {
    Body_start<3> start;
    start.cloud = Particle_cloud{6, 3, 5};
    start.material = material;
    scene.bodies.push_back(start);
  }
  World<3> world(snapshot, scene, {hexahedron_body(1, false), icosphere_body(0.7, 1)});
  std::size_t contacts = 0, of_edges = 0;
  for (int i = 0; i < 300; ++i) {
    world.step();
    contacts += world.contacts().size();
    for (const auto& c : world.contacts()) of_edges += c.contact.body == Body_feature::edge;
    if (i % 5 == 0) world.validate();
  }
  EXPECT_GT(contacts, 300u);
  EXPECT_GT(of_edges, 30u);
}

TEST(RodInAnAneurysm, GoesThroughIt) {
  const Snapshot<3>& snapshot = aneurysm().snapshot();
  Point<3> low = snapshot.point(0), high = low;
  for (const Point<3>& x : snapshot.points())
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  Vector<3> direction{};
  direction[axis] = 1;
  Scene<3> scene;
  Catheter<3> catheter;
  catheter.path = {end_of(snapshot, -1.0 * direction), end_of(snapshot, direction)};
  catheter.find_route = true;
  catheter.spacing = length(high - low) / 150;
  catheter.advance = catheter.spacing / 2;
  catheter.particles = 400;
  catheter.stiffness = 0.8;
  scene.catheter = catheter;
  World<3> world(snapshot, scene);
  std::size_t of_edges = 0;
  for (int i = 0; i < 800 && !world.catheter()->has_arrived(); ++i) {
    world.step();
    for (const auto& c : world.contacts()) of_edges += c.contact.body == Body_feature::edge;
    if (i % 10 == 0) world.validate();
  }
  world.validate();
  std::cout << world.steps_done() << " steps, " << world.catheter()->length_inside()
            << " inside, box of diagonal " << length(high - low) << ", " << of_edges
            << " contacts of edges\n";
  EXPECT_TRUE(world.catheter()->has_arrived());
  EXPECT_GT(world.catheter()->length_inside(), high[axis] - low[axis] - 4 * catheter.spacing);
  EXPECT_GT(of_edges, 50u);
}

}  // namespace
}  // namespace cellwalk
