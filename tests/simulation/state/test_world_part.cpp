// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds that advance a part each do together what one world does.
#include <cellwalk/internal/simulation/world_part.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

template <int D>
Scene<D> crowd() {
  Scene<D> scene;
  for (const std::uint64_t seed : {3, 4}) {
    Body_start<D> start;
    start.cloud = Particle_cloud{7, 3, seed};
    start.spin[0] = 1;
    if (seed == 4) start.material = Shape_material{};
    scene.bodies.push_back(start);
  }
  scene.particles.push_back(Particle_cloud{5, 4, 9});
  scene.gravity[D - 1] = -1;
  scene.time_step = 0.05;
  return scene;
}

template <int D>
void expect_same_contacts(const World<D>& world, const World<D>& parts) {
  ASSERT_EQ(parts.contacts().size(), world.contacts().size());
  for (std::size_t i = 0; i < world.contacts().size(); ++i) {
    const Run_contact<D>&a = world.contacts()[i], &b = parts.contacts()[i];
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.body, b.body);
    EXPECT_EQ(a.body ? 0 : a.particle, b.body ? 0 : b.particle);
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.contact.time, b.contact.time);
    EXPECT_EQ(a.contact.point, b.contact.point);
    EXPECT_EQ(a.contact.normal, b.contact.normal);
    EXPECT_EQ(a.contact.kind, b.contact.kind);
    EXPECT_EQ(a.contact.corner, b.contact.corner);
    EXPECT_EQ(a.contact.facet, b.contact.facet);
    EXPECT_EQ(a.contact.cell, b.contact.cell);
    EXPECT_EQ(a.contact.body, b.contact.body);
    EXPECT_EQ(a.contact.vertex, b.contact.vertex);
    EXPECT_EQ(a.contact.feature, b.contact.feature);
  }
}

template <int D>
void expect_same_states(const World<D>& world, const World<D>& parts) {
  for (std::size_t i = 0; i < world.particles().size(); ++i) {
    EXPECT_EQ(world.particles()[i].position, parts.particles()[i].position) << i;
    EXPECT_EQ(world.particles()[i].cell, parts.particles()[i].cell) << i;
    EXPECT_EQ(world.velocities()[i], parts.velocities()[i]) << i;
  }
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    EXPECT_TRUE(std::ranges::equal(world.positions(b), parts.positions(b))) << b;
    for (std::uint32_t v = 0; v < world.positions(b).size(); ++v)
      EXPECT_EQ(world.cell_of(b, v), parts.cell_of(b, v)) << b;
    EXPECT_EQ(world.has_arrived(b), parts.has_arrived(b)) << b;
    EXPECT_EQ(named_counts(world.body_counts(b)), named_counts(parts.body_counts(b))) << b;
  }
  EXPECT_EQ(named_counts(world.counts()), named_counts(parts.counts()));
  EXPECT_EQ(named_counts(world.body_counts().edges), named_counts(parts.body_counts().edges));
}

template <int D>
void run_in_parts(const Snapshot<D>& snapshot, const Scene<D>& scene, const std::vector<Body_soup<D>>& shapes,
                  std::size_t count) {
  constexpr int steps = 40;
  World<D> world(snapshot, scene, shapes);
  std::deque<World<D>> worlds;  // what parts refer to must not move
  std::vector<World_part<D>> parts;
  for (std::size_t i = 0; i < count; ++i)
    parts.emplace_back(worlds.emplace_back(snapshot, scene, shapes), i, count);
  std::size_t contacts = 0;
  for (int step = 1; step <= steps; ++step) {
    world.step();
    for (World<D>& each : worlds) each.step();
    for (std::size_t i = 1; i < count; ++i) parts[0].take_over(parts[i].state_of_part({true, step % 8 == 0}));
    parts[0].sort_contacts();
    expect_same_contacts(world, worlds[0]);
    if (step % 8 == 0) expect_same_states(world, worlds[0]);
    contacts += world.contacts().size();
  }
  EXPECT_GT(contacts, 20u);
  world.validate();
  for (World<D>& each : worlds) each.validate();
  for (std::size_t i = 1; i < count; ++i) parts[0].take_over(parts[i].state_of_part({false, true}));
  expect_same_states(world, worlds[0]);
}

TEST(WorldPart, PartsDoInThePlaneWhatOneWorldDoes) {
  const auto snapshot = rooms<2>({8, 8}, {26, 45});
  for (const std::size_t count : {1, 2, 3, 40})
    run_in_parts<2>(
        snapshot, crowd<2>(),
        {{{{0, 0}, {0.4, 0}, {0, 0.4}}, {{0, 1}, {0, 2}, {1, 2}}, {}}, {{{0, 0}, {0.3, 0}}, {{0, 1}}, {}}},
        count);
}

TEST(WorldPart, PartsDoInSpaceWhatOneWorldDoes) {
  const auto snapshot = rooms<3>({4, 4, 4}, {21, 42});
  Scene<3> scene = crowd<3>();
  Catheter<3> catheter;
  catheter.path = {{0.5, 0.5, 0.2}, {0.5, 0.5, 3.5}};
  catheter.spacing = 0.2;
  catheter.particles = 12;
  catheter.advance = 0.1;
  scene.catheter = catheter;
  const Body_soup<3> shape{{{0, 0, 0}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}},
                           {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
                           {}};
  for (const std::size_t count : {2, 3}) run_in_parts<3>(snapshot, scene, {shape, shape}, count);
}

TEST(WorldPart, BytesOfOtherScenesAreRefused) {
  const auto snapshot = rooms<2>({8, 8}, {26});
  Scene<2> few = crowd<2>();
  few.bodies.pop_back();
  const Body_soup<2> shape{{{0, 0}, {0.4, 0}}, {{0, 1}}, {}};
  World<2> world(snapshot, few, {shape}), other(snapshot, crowd<2>(), {shape, shape});
  World_part<2> part(world, 0, 2), second(other, 1, 2);
  EXPECT_THROW(part.take_over(second.state_of_part({false, true})), Error);
  EXPECT_THROW(part.take_over("cut short"), Error);
}

}  // namespace
}  // namespace cellwalk
