// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <string>
#include <vector>

#include "reshape/grids.h"
#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

template <int D>
Scene<D> cloud_scene(std::uint32_t count, double speed, std::uint64_t seed) {
  Scene<D> scene;
  scene.particles.push_back(Particle_cloud{count, speed, seed});
  return scene;
}

/// Runs a world and checks, at every step, what must hold whatever the scene: I1 by the world's own check and
/// by the locator, and that every reported contact lies in a wall and has its normal. Returns the number of
/// contacts of each kind.
template <int D>
std::array<std::size_t, 3> run_checked(const Snapshot<D>& snapshot, World<D>& world, int steps) {
  const Locator<D> locator(snapshot);
  std::array<std::size_t, 3> kinds{};
  for (int i = 0; i < steps; ++i) {
    world.step();
    world.validate();
    for (std::size_t k = 0; k < world.particles().size(); ++k)
      EXPECT_TRUE(test::is_where_it_says(locator, world.particles()[k]))
          << "particle " << k << ", step " << i;
    for (const Run_contact<D>& c : world.contacts()) {
      EXPECT_TRUE(test::lies_in_a_wall(snapshot, c.contact.point, c.contact.normal, 1e-9))
          << "particle " << c.particle << ", step " << i;
      EXPECT_NEAR(length(c.contact.normal), 1, 1e-15);
      EXPECT_TRUE(Exact_time() <= c.contact.exact_time() && c.contact.exact_time() <= Exact_time(1));
      EXPECT_EQ(c.step, world.steps_done());
      ++kinds[static_cast<std::size_t>(c.contact.kind)];
    }
  }
  return kinds;
}

std::size_t sum(const std::array<std::size_t, 3>& kinds) { return kinds[0] + kinds[1] + kinds[2]; }

template <int D>
void bounce_in_lattice_worlds(const Lattice_map<D>& map) {
  std::array<std::size_t, 3> kinds{};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    auto options = mixed_lattice_world<D>(seed);
    options.map = map;
    const auto snapshot = test::compile(lattice_world(options));
    auto scene = cloud_scene<D>(20, 20, seed);
    scene.time_step = 1.0 / 64;
    scene.restitution = 0.25 * static_cast<double>(seed);
    scene.friction = 0.1;
    // Some start on the lattice and move along it: within wall planes, through edges and into corners.
    // Gravity would lead them off it.
    if (seed > 2) scene.gravity[D - 1] = -10;
    const Locator<D> locator(snapshot);
    for (std::size_t i = 0, placed = 0; placed < 20 && i < snapshot.points().size(); ++i) {
      if (locator.locate(snapshot.points()[i]).status != Location_status::free) continue;
      const Vector<D> v = 32 * (map.columns[i % D] + map.columns[(i / D) % D]);
      scene.particles.push_back(Particle_start<D>{snapshot.points()[i], v});
      ++placed;
    }
    World<D> world(snapshot, scene);
    const auto met = run_checked(snapshot, world, 40);
    for (std::size_t k = 0; k < 3; ++k) kinds[k] += met[k];
  }
  EXPECT_GT(kinds[static_cast<std::size_t>(Contact_kind::facet)], 200u);
  EXPECT_GT(kinds[static_cast<std::size_t>(Contact_kind::vertex)], 0u);
  EXPECT_TRUE(D == 2 || kinds[static_cast<std::size_t>(Contact_kind::edge)] > 0);
}

TEST(World, ParticlesStayInFreeSpace2) { bounce_in_lattice_worlds<2>({}); }
TEST(World, ParticlesStayInFreeSpace3) { bounce_in_lattice_worlds<3>({}); }
TEST(World, ParticlesStayInFreeSpaceBetweenObliqueWalls2) { bounce_in_lattice_worlds<2>(rotated<2>(1)); }
TEST(World, ParticlesStayInFreeSpaceBetweenObliqueWalls3) { bounce_in_lattice_worlds<3>(rotated<3>(1)); }

TEST(World, ParticlesAtRestStayAtRestOnTheFloor) {
  const auto snapshot = rooms<3>({3, 3, 3});
  Scene<3> scene;
  scene.particles.push_back(Particle_start<3>{{1.5, 1.25, 0}, {}});
  scene.gravity = {0, 0, -9.81};
  scene.restitution = 0;
  World<3> world(snapshot, scene);
  EXPECT_EQ(sum(run_checked(snapshot, world, 50)), 50u);
  EXPECT_LT(length(world.particles()[0].position - Point<3>{1.5, 1.25, 0}), 1e-12);
}

TEST(World, IsDeterministic) {
  const auto snapshot = test::compile(lattice_world(mixed_lattice_world<3>(7)));
  const auto hash = [&](std::uint64_t seed) {
    auto scene = cloud_scene<3>(30, 30, seed);
    scene.restitution = 0.7;
    World<3> world(snapshot, scene);
    std::uint64_t h = 0;
    for (int i = 0; i < 50; ++i) {
      world.step();
      for (const auto& p : world.particles())
        for (const double x : p.position) h = scramble(h ^ std::bit_cast<std::uint64_t>(x));
    }
    return h;
  };
  EXPECT_EQ(hash(1), hash(1));
  EXPECT_NE(hash(1), hash(2));
}

TEST(World, GivesTheSameBitsWithEveryCompiler) {
  Scene<3> scene = cloud_scene<3>(10, 40, 3);
  scene.gravity = {0, -1, -9.81};
  scene.restitution = 0.8;
  scene.friction = 0.05;
  const auto snapshot = rooms<3>({4, 4, 4}, {21, 42});
  World<3> world(snapshot, scene);
  std::size_t contacts = 0;
  std::uint64_t h = 0;
  for (int i = 0; i < 100; ++i) {
    world.step();
    contacts += world.contacts().size();
  }
  for (const auto& p : world.particles())
    for (const double x : p.position) h = scramble(h ^ std::bit_cast<std::uint64_t>(x));
  EXPECT_GT(contacts, 50u);
  EXPECT_EQ(h, 6908961827922818978u);
}

TEST(World, RandomParticlesFillFreeSpaceEvenly) {
  const auto snapshot = rooms<2>({4, 1}, {1});
  World<2> world(snapshot, cloud_scene<2>(3000, 2, 9));
  std::array<int, 4> in_cell{};
  for (std::size_t i = 0; i < world.particles().size(); ++i) {
    ++in_cell[snapshot.index(world.particles()[i].cell)];
    EXPECT_NEAR(length(world.velocities()[i]), 2, 1e-12);
  }
  EXPECT_EQ(in_cell[1], 0);
  for (const int i : {0, 2, 3}) EXPECT_NEAR(in_cell[static_cast<std::size_t>(i)], 1000, 120);
}

template <class Make>
std::string refusal(Make make) {
  try {
    make();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Error_code::outside);
    return e.what();
  }
  return "accepted";
}

TEST(World, RefusesStartsOutsideFreeSpace) {
  const auto snapshot = rooms<2>({3, 1}, {1});
  Scene<2> scene;
  scene.particles = {Particle_start<2>{{0.5, 0.5}, {}}, Particle_start<2>{{1.5, 0.5}, {}}};
  EXPECT_EQ(refusal([&] { World<2>(snapshot, scene); }),
            "particles[1].position: (1.5, 0.5) lies in a solid cell; put it into free space");
  scene.particles[1] = Particle_start<2>{{0.5, 1.5}, {}};
  EXPECT_EQ(refusal([&] { World<2>(snapshot, scene); }),
            "particles[1].position: (0.5, 1.5) lies outside the environment; put it into free space");
  scene = {};
  scene.catheter = Catheter<2>{};
  scene.catheter->find_route = true;
  scene.catheter->path = {{0.5, 0.5}, {2.5, 0.5}};
  EXPECT_EQ(refusal([&] { World<2>(snapshot, scene); }),
            "catheter.path[1]: walls cut it off from the waypoint before; move it or open a wall");
  scene.catheter->path[0] = {-1, 0};
  EXPECT_EQ(refusal([&] { World<2>(snapshot, scene); }),
            "catheter.path[0]: (-1, 0) lies outside the environment; put it into free space");
}

TEST(World, ValidateCatchesAParticleOutsideItsCell) {
  const auto snapshot = rooms<3>({2, 1, 1});
  EXPECT_TRUE(in_closure(snapshot, snapshot.cell(0), {1, 1, 1}));
  EXPECT_TRUE(in_closure(snapshot, snapshot.cell(0), {0.5, 0, 1}));
  EXPECT_FALSE(in_closure(snapshot, snapshot.cell(0), {std::nextafter(1.0, 2.0), 0.5, 0.5}));
  EXPECT_FALSE(in_closure(snapshot, snapshot.cell(1), {0.5, 0.5, 0.5}));
}

TEST(World, IsOfTheEnvironmentAsItWasWhenItWasMade) {
  auto snapshot = rooms<2>({3, 3});
  const auto scene = cloud_scene<2>(20, 2, 1);
  World<2> world(snapshot, scene);
  world.step();
  for (std::size_t k = 0; k < 4; ++k) snapshot.set_impassable(snapshot.half_facet(snapshot.cell(4), k), true);
  const std::vector<Particle<2>> before(world.particles().begin(), world.particles().end());
  for (const auto& use :
       std::vector<std::function<void()>>{[&] { world.step(); }, [&] { world.validate(); }}) {
    try {
      use();
      ADD_FAILURE() << "an edit was not noticed";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::usage);
      EXPECT_NE(std::string(error.what()).find("make a new one"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(world.steps_done(), 1u);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(world.particles()[i].position, before[i].position);
  World<2> anew(snapshot, scene);
  EXPECT_NO_THROW(anew.step());
}

/// Cells are replaced among particles that fly on as if nothing had happened.
template <int D>
void relax_among_particles() {
  auto environment = test::simplex_grid<D>(4);
  const Snapshot<D>& snapshot = environment.snapshot();
  const auto scene = cloud_scene<D>(60, 30, 5);
  World<D> world(snapshot, scene);
  while (world.contacts().empty()) world.step();
  Random random(7);
  std::vector<Vertex_move<D>> moves;
  std::vector<std::uint32_t> points;
  for (std::uint32_t v = 0; v < snapshot.points().size(); ++v) {
    points.push_back(v);
    Point<D> x = snapshot.point(v);
    if (std::ranges::any_of(x, [](double c) { return c == 0 || c == 4; })) continue;
    for (double& c : x) c += random.real(-0.9, 0.9);
    moves.push_back({v, x});
  }
  Reshape_counts counts;
  world.move_walls(environment, moves, {}, counts);
  EXPECT_NE(world.contacts()[0].contact.facet, Half_facet::none);
  const Relax_report report = world.relax(environment, points, {}, counts);
  EXPECT_GT(report.flipped, 0u);
  EXPECT_GT(report.least_after, report.least_before);
  EXPECT_EQ(world.contacts()[0].contact.facet, Half_facet::none) << "its name may be another's now";
  environment.certify();
  std::size_t met = 0;
  const auto anew = test::simplex_grid<D>(4);
  World<D> other(anew.snapshot(), scene);
  EXPECT_THROW(other.relax(environment, points, {}, counts), Error);
  while (other.steps_done() < world.steps_done()) other.step();
  for (int i = 0; i < 20; ++i) {
    world.step();
    other.step();
    world.validate();
    met += world.contacts().size();
    EXPECT_EQ(world.contacts().size(), other.contacts().size());
    for (std::size_t k = 0; k < world.particles().size(); ++k)
      EXPECT_LT(length(world.particles()[k].position - other.particles()[k].position), 1e-9);
  }
  EXPECT_GT(met, 10u);
}

TEST(World, RelaxesCellsAmongWhatMoves) {
  relax_among_particles<2>();
  relax_among_particles<3>();
}

}  // namespace
}  // namespace cellwalk
