// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies in a world: where they start, what they meet, and what never happens to them.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <bit>
#include <cmath>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::pierces;
using test::rooms;

/// Copies thrown at random among free particles.
template <int D>
Scene<D> thrown(std::uint32_t count, double speed, std::uint64_t seed) {
  Scene<D> scene;
  Body_start<D> start;
  start.cloud = Particle_cloud{count, speed, seed};
  start.spin[0] = 1;
  scene.bodies.push_back(start);
  scene.particles.push_back(Particle_cloud{5, speed, seed});
  scene.time_step = 0.05;
  return scene;
}

struct Seen_contacts {
  std::size_t by_vertex = 0, by_edge = 0, of_particles = 0;
};

/// Runs a world of solid unit cells, and at every step: validates, sees that no vertex is outside and no edge
/// goes through a solid cell, and that every contact of a body lies in a wall and names what there is.
template <int D>
void run_checked(World<D>& world, const Point<D>& size, const std::vector<Point<D>>& solid, int steps,
                 Seen_contacts& seen) {
  constexpr double margin = 1e-9;
  for (int i = 0; i < steps; ++i) {
    world.step();
    world.validate();
    for (const Moving_body<D>& rigid_body : world.bodies()) {
      const auto positions = rigid_body.body().positions();
      for (const Point<D>& x : positions)
        for (int k = 0; k < D; ++k) EXPECT_TRUE(x[k] >= 0 && x[k] <= size[k]) << "step " << i;
      for (const auto& [u, v] : rigid_body.body().edges())
        for (const Point<D>& low : solid)
          EXPECT_FALSE(pierces<D>(positions[u], positions[v], low, margin)) << "step " << i;
    }
    for (const Run_contact<D>& c : world.contacts()) {
      EXPECT_EQ(c.step, world.steps_done());
      EXPECT_NEAR(length(c.contact.normal), 1, 1e-14);
      EXPECT_TRUE(Exact_time() <= c.contact.exact_time() && c.contact.exact_time() <= Exact_time(1));
      if (!c.body) {
        ++seen.of_particles;
        continue;
      }
      const Body<D>& body = world.bodies()[*c.body].body();
      ASSERT_LT(c.contact.vertex, body.vertex_count());
      if (c.contact.body == Body_feature::vertex) {
        EXPECT_EQ(c.contact.feature, c.contact.vertex);
        ++seen.by_vertex;
      } else {
        ASSERT_EQ(c.contact.body, Body_feature::edge);
        ASSERT_LT(c.contact.feature, body.edges().size());
        const auto [u, v] = body.edges()[c.contact.feature];
        EXPECT_TRUE(u == c.contact.vertex || v == c.contact.vertex);
        ++seen.by_edge;
      }
      // All walls of these worlds are parallel to the axes: a coordinate of the point is whole.
      bool is_whole = false;
      for (const double x : c.contact.point) is_whole = is_whole || std::abs(x - std::round(x)) < 1e-9;
      EXPECT_TRUE(is_whole);
    }
  }
}

TEST(WorldBodies, NothingPassesAWall2) {
  const auto snapshot = rooms<2>({6, 6}, {14, 16, 27});  // cell x + 6 y
  auto scene = thrown<2>(15, 3, 5);
  scene.gravity = {0, -1};
  World<2> world(snapshot, scene, {polygon_body(5, 0.3)});
  ASSERT_EQ(world.bodies().size(), 15u);
  Seen_contacts seen;
  run_checked<2>(world, {6, 6}, {{2, 2}, {4, 2}, {3, 4}}, 300, seen);
  EXPECT_GT(seen.by_vertex, 300u);
  EXPECT_GT(seen.by_edge, 20u);
  EXPECT_GT(seen.of_particles, 20u);
  EXPECT_EQ(world.body_counts().contacts, seen.by_vertex + seen.by_edge);
  EXPECT_GT(world.body_counts().in_region, 1000u);
}

TEST(WorldBodies, NothingPassesAWall3) {
  const auto snapshot = rooms<3>({4, 4, 3}, {21, 26});  // cell x + 4 (y + 4 z)
  World<3> world(snapshot, thrown<3>(10, 2, 9), {hexahedron_body(0.4, false)});
  Seen_contacts seen;
  run_checked<3>(world, {4, 4, 3}, {{1, 1, 1}, {2, 2, 1}}, 200, seen);
  EXPECT_GT(seen.by_vertex, 100u);
  EXPECT_GT(seen.by_edge, 10u);
}

template <int D>
std::uint64_t hash_of(const World<D>& world, std::uint64_t h = 0) {
  for (const auto& rigid_body : world.bodies())
    for (const auto& x : rigid_body.body().positions())
      for (const double c : x) h = scramble(h ^ std::bit_cast<std::uint64_t>(c));
  return h;
}

TEST(WorldBodies, IsDeterministicAndValidationChangesNothing) {
  const auto snapshot = rooms<3>({4, 4, 3}, {21, 26});
  const auto run = [&](std::uint64_t seed, bool validate, const Body_options& options) {
    World<3> world(snapshot, thrown<3>(8, 2, seed), {hexahedron_body(0.4, false)}, options);
    std::uint64_t h = 0;
    for (int i = 0; i < 100; ++i) {
      world.step();
      if (validate) world.validate();
      h = hash_of(world, h);
    }
    EXPECT_EQ(world.body_counts().in_region == 0, !options.clearance);
    return h;
  };
  Body_options plain;
  plain.clearance = false;
  EXPECT_EQ(run(1, false, {}), run(1, true, {}));
  EXPECT_EQ(run(1, false, {}), run(1, false, plain));
  EXPECT_NE(run(1, false, {}), run(2, false, {}));
}

TEST(WorldBodies, AnyNumberOfThreadsGivesTheSameBits) {
  const auto snapshot = rooms<3>({4, 4, 3}, {21, 26});
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    World<3> world(snapshot, thrown<3>(40, 2, 5), {hexahedron_body(0.4, false)});
    std::uint64_t h = 0;
    std::size_t contacts = 0;
    for (int i = 0; i < 60; ++i) {
      world.step();
      h = hash_of(world, h);
      for (const auto& c : world.contacts()) {
        h = scramble(h ^ std::bit_cast<std::uint64_t>(c.contact.time) ^ *c.body);
        ++contacts;
      }
    }
    EXPECT_GT(contacts, 200u);
    return std::pair{h, world.body_counts().edges.walk.walks};
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(WorldBodies, CopiesStartEverywhereInAllDirections) {
  const auto snapshot = rooms<2>({4, 1}, {1});
  auto scene = thrown<2>(300, 2, 9);
  scene.bodies[0].placement.scale = 0.5;
  scene.bodies[0].placement.rotation.degrees = 90;
  const World<2> world(snapshot, scene, {catheter_body<2>(0.4, 2)});
  std::array<int, 4> in_cell{};
  Vector<2> sum{};
  for (const Moving_body<2>& rigid_body : world.bodies()) {
    const auto x = rigid_body.body().positions();
    EXPECT_EQ(x[0][0], x[1][0]) << "turned upright";
    EXPECT_NEAR(x[1][1] - x[0][1], 0.2, 1e-15);
    ++in_cell[static_cast<std::size_t>(x[0][0])];
    EXPECT_NEAR(length(rigid_body.velocity()), 2, 1e-12);
    sum = sum + rigid_body.velocity();
  }
  EXPECT_EQ(in_cell[1], 0);
  for (const int i : {0, 2, 3}) EXPECT_NEAR(in_cell[static_cast<std::size_t>(i)], 100, 40);
  EXPECT_LT(length(sum), 100) << "of 600 if all flew alike";
}

/// A square that is led against the wall x = 4 and along it.
Scene<2> guided() {
  Scene<2> scene;
  Body_start<2> start;
  start.guided = Guided_motion<2>{{{1, 1}, {4.1, 1}, {4.1, 3}, {2, 3}}, 1};
  scene.bodies.push_back(start);
  scene.time_step = 0.05;
  return scene;
}

TEST(WorldBodies, AGuidedBodyIsStoppedByAWallAndSlidesAlongIt) {
  const auto snapshot = rooms<2>({4, 4});
  World<2> world(snapshot, guided(), {quad_body(0.5)});
  const auto x = [&](std::uint32_t v) { return world.bodies()[0].body().positions()[v]; };
  EXPECT_EQ(x(0), (Point<2>{0.75, 0.75})) << "starts at the first waypoint";
  std::size_t contacts = 0, slid = 0;
  for (int i = 0; i < 100; ++i) {
    world.step();
    world.validate();
    for (const auto& c : world.contacts()) {
      ++contacts;
      EXPECT_EQ(c.contact.normal, (Vector<2>{-1, 0}));
      EXPECT_NEAR(c.contact.point[0], 4, 1e-12);
    }
    if (i < 63 || i >= 101)
      continue;  // from (4.1, 1.05) on: the right side is held at the wall, the left one is not
    ++slid;
    EXPECT_NEAR(x(1)[0], 4, 1e-12);
    EXPECT_NEAR(x(2)[0], 4, 1e-12);
    EXPECT_NEAR(x(0)[0], 3.85, 1e-12);
    EXPECT_NEAR(x(1)[1], 1 + 0.05 * (i + 1) - 3.1 - 0.25, 1e-9) << "keeps up with its guide";
  }
  EXPECT_GT(contacts, 50u);
  EXPECT_EQ(slid, 37u);
  EXPECT_FALSE(world.bodies()[0].has_arrived());
  for (int i = 0; i < 50; ++i) world.step();
  EXPECT_TRUE(world.bodies()[0].has_arrived());
  EXPECT_LT(length(x(2) - Point<2>{2.25, 3.25}), 1e-12) << "has its shape again";
}

TEST(WorldBodies, AGuidedBodyThatIsHeldBackHasNotArrived) {
  const auto snapshot = rooms<2>({4, 4});
  auto scene = guided();
  scene.bodies[0].guided->path = {{1, 1}, {3.8, 1}};
  World<2> world(snapshot, scene, {quad_body(0.5)});
  for (int i = 0; i < 80; ++i) world.step();
  EXPECT_FALSE(world.bodies()[0].has_arrived());
  scene.bodies[0].guided->path[1] = {3.75, 1};
  World<2> touching(snapshot, scene, {quad_body(0.5)});
  for (int i = 0; i < 50; ++i) touching.step();
  EXPECT_FALSE(touching.bodies()[0].has_arrived()) << "on its way";
  for (int i = 0; i < 10; ++i) touching.step();
  EXPECT_TRUE(touching.bodies()[0].has_arrived()) << "touching is no contact";
}

TEST(WorldBodies, AGuidedBodyTurnsAboutItsOrigin) {
  const auto snapshot = rooms<2>({4, 4});
  auto scene = guided();
  scene.bodies[0].guided->path = {{1, 1}, {3, 1}};
  scene.bodies[0].spin = {1};
  World<2> world(snapshot, scene, {quad_body(0.5)});
  for (int i = 0; i < 20; ++i) world.step();
  const Vector<2> corner = world.bodies()[0].body().positions()[0] - Point<2>{2, 1};
  EXPECT_NEAR(std::atan2(corner[1], corner[0]), std::atan2(-1, -1) + 1, 1e-12);
}

std::string refusal(const Snapshot<2>& snapshot, const Scene<2>& scene, const Body_soup<2>& shape) {
  try {
    World<2>(snapshot, scene, std::vector<Body_soup<2>>(scene.bodies.size(), shape));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Error_code::outside);
    return e.what();
  }
  return "accepted";
}

TEST(WorldBodies, RefusesStartsOutsideFreeSpace) {
  const auto snapshot = rooms<2>({3, 1}, {1});
  Scene<2> scene;
  scene.bodies.resize(2);
  scene.bodies[0].placement.position = {0.5, 0.5};
  scene.bodies[1].placement.position = {1, 0.5};
  const Body_soup<2> rod = catheter_body<2>(0.5, 2);
  EXPECT_EQ(
      refusal(snapshot, scene, rod),
      "bodies[1]: vertex 1 of the body, at (1.25, 0.5), is in a solid cell: move the body into free space");
  const Body_soup<2> long_rod = catheter_body<2>(2, 2);
  scene.bodies[0] = scene.bodies[1];
  scene.bodies[0].placement.position = {1.5, 0.5};
  EXPECT_EQ(refusal(snapshot, scene, long_rod),
            "bodies[0]: edge 0 of the body, from vertex 0 at (0.5, 0.5) to vertex 1 at (2.5, 0.5), crosses a "
            "wall at "
            "(1, 0.5), in cell 0: move the body into free space");
  scene.bodies[0].cloud = Particle_cloud{7, 1, 1};
  EXPECT_EQ(refusal(snapshot, scene, long_rod),
            "bodies[0]: no room for copy 1 of 7: it meets walls at each of 1000 random places; make the body "
            "smaller, or "
            "the free space larger");
}

/// What a step says that is refused; empty if none is.
template <int D>
std::string refusal_of_steps(World<D>& world, int steps) {
  try {
    for (int i = 0; i < steps; ++i) world.step();
    world.validate();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::input) << error.what();
    try {
      world.step();
      ADD_FAILURE() << "it goes on";
    } catch (const Error& again) {
      // A time that is not finite is found before anything moves: again, too.
      EXPECT_TRUE(again.code() == Error_code::usage || std::string(again.what()) == error.what())
          << again.what();
    }
    return error.what();
  }
  return {};
}

TEST(WorldBodies, AreRefusedIfTheirMotionIsNotFinite) {
  const auto snapshot = rooms<3>({3, 3, 3});
  for (const bool deforms : {false, true})
    for (const int what : {0, 1, 2, 3, 4}) {
      Scene<3> scene = thrown<3>(1, 1, 3);
      if (deforms) scene.bodies[0].material = Shape_material{};
      if (what == 0) scene.gravity = {0, 0, -1e308};
      if (what == 1) scene.time_step = 1e300, scene.bodies[0].cloud->speed = 1e10;
      if (what == 2) scene.bodies[0].spin = {1e308, 1e308, 1e308};
      if (what == 3) scene.bodies[0].cloud->speed = deforms ? 1e100 : 1e200;  // finite
      if (what == 4) scene.time_step = 1e308;
      if (what == 0) scene.time_step = 1000;
      World<3> world(snapshot, scene, {hexahedron_body(0.4, false)});
      const std::string said = refusal_of_steps(world, 5);
      if (what == 3)
        EXPECT_EQ(said, "") << deforms;
      else
        EXPECT_TRUE(said.find(what == 4 ? "step" : " in step 1: ") != std::string::npos &&
                    said.find("is not finite: take a smaller time step") != std::string::npos)
            << said;
    }
}

TEST(WorldBodies, NoStepIsSoLongOrMotionSoFastThatResultsAreNotFinite) {
  const auto snapshot = rooms<2>({4, 4});
  int refused = 0, made = 0;
  for (const bool deforms : {false, true})
    for (const bool particle : {false, true})
      for (const double time_step : {1e-320, 1e-3, 1.0, 1e100, 1e300})
        for (const double speed : {0.0, 1.0, 1e100, 1e300})
          for (const double gravity : {0.0, 1e300}) {
            Scene<2> scene = thrown<2>(1, speed, 3);
            scene.time_step = time_step;
            scene.gravity = {0, -gravity};
            if (deforms) scene.bodies[0].material = Shape_material{};
            if (particle) scene.particles = {Particle_start<2>{{1.5, 1.5}, {speed, speed}}};
            World<2> world(snapshot, scene, {quad_body(0.25)});
            const bool is_made = refusal_of_steps(world, 2).empty();
            (is_made ? made : refused) += 1;
            if (is_made) {
              for (const Vector<2>& v : world.velocities()) EXPECT_TRUE(is_finite(v));
            }
            for (std::size_t b = 0; b < world.bodies().size(); ++b) {
              for (const Point<2>& x : world.positions(b)) EXPECT_TRUE(is_finite(x));
              if (is_made) {
                EXPECT_TRUE(is_finite(world.bodies()[b].velocity()))
                    << time_step << ' ' << speed << ' ' << gravity;
              }
            }
            for (const auto& met : world.contacts())
              EXPECT_TRUE(is_finite(met.contact.point) && is_finite(met.contact.normal) &&
                          std::isfinite(met.contact.time));
          }
  EXPECT_EQ(refused + made, 160);
  EXPECT_GE(refused, 40);
  EXPECT_GE(made, 40);
}

TEST(WorldBodies, NeedAShapeEach) {
  const auto snapshot = rooms<2>({4, 4});
  EXPECT_THROW(World<2>(snapshot, guided()), Error);
  EXPECT_NO_THROW(World<2>(snapshot, guided(), {quad_body(0.5)}));
}

}  // namespace
}  // namespace cellwalk
