// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds that are saved and restored at any step go on as if they had never stopped.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using Bytes = std::vector<std::byte>;

template <int D>
Bytes bytes_of(const World<D>& world) {
  detail::Byte_writer out;
  detail::save(out, world);
  return out.take();
}

template <int D>
World<D> restored(const Snapshot<D>& snapshot, const Scene<D>& scene, const Bytes& bytes) {
  detail::Byte_reader in(bytes);
  World<D> world = detail::State_access<D>(snapshot, scene).read_world(in, {});
  in.expect_end();
  return world;
}

/// Bodies that are thrown, guided, soft, and a catheter, among particles.
template <int D>
Scene<D> scene_of_all() {
  Scene<D> scene;
  scene.time_step = 0.05;
  scene.gravity[D - 1] = -2;
  scene.restitution = 0.8;
  scene.friction = 0.1;
  scene.particles.push_back(Particle_cloud{10, 3, 5});
  Body_start<D> thrown, soft, guided;
  thrown.cloud = Particle_cloud{4, 2, 6};
  thrown.spin[0] = 1;
  soft.cloud = Particle_cloud{3, 2, 7};
  soft.material = Shape_material{};
  soft.material->stiffness = 0.5;
  Point<D> from, to;
  from.fill(0.5);
  to.fill(0.5);
  to[0] = 5;  // beyond a wall
  guided.guided = Guided_motion<D>{{from, to}, 2};
  scene.bodies = {thrown, soft, guided};
  Catheter<D> catheter;
  catheter.particles = 40;
  catheter.spacing = 0.1;
  catheter.advance = 0.05;
  catheter.path = {from, to};
  scene.catheter = catheter;
  return scene;
}

Body_soup<2> small_body(std::integral_constant<int, 2>) { return quad_body(0.3); }
Body_soup<3> small_body(std::integral_constant<int, 3>) { return hexahedron_body(0.3); }

template <int D>
void go_on(const Snapshot<D>& snapshot) {
  const Scene<D> scene = scene_of_all<D>();
  const Body_soup<D> body = small_body(std::integral_constant<int, D>());
  World<D> world(snapshot, scene, {body, body, body});
  std::optional<World<D>> twin;
  std::size_t contacts = 0;
  for (int step = 0; step < 60; ++step) {
    if (step % 7 == 0) {
      const Bytes bytes = bytes_of(twin ? *twin : world);
      twin = restored(snapshot, scene, bytes);
      ASSERT_TRUE(bytes_of(*twin) == bytes) << "step " << step;
    }
    world.step();
    twin->step();
    contacts += world.contacts().size();
    ASSERT_EQ(world.contacts().size(), twin->contacts().size());
    for (std::size_t i = 0; i < world.contacts().size(); ++i)
      EXPECT_TRUE(world.contacts()[i].contact.exact_time() == twin->contacts()[i].contact.exact_time());
    ASSERT_TRUE(bytes_of(*twin) == bytes_of(world)) << "step " << step;
    // What is not saved at all would not be seen by that.
    EXPECT_EQ(twin->steps_done(), world.steps_done());
    EXPECT_TRUE(std::ranges::equal(twin->velocities(), world.velocities()));
    EXPECT_EQ(std::bit_cast<Count_array<Walk_counts>>(twin->counts()),
              std::bit_cast<Count_array<Walk_counts>>(world.counts()));
    EXPECT_EQ(std::bit_cast<Count_array<Body_counts>>(twin->body_counts()),
              std::bit_cast<Count_array<Body_counts>>(world.body_counts()));
    for (std::size_t b = 0; b < world.bodies().size(); ++b)
      EXPECT_TRUE(
          std::ranges::equal(twin->bodies()[b].body().positions(), world.bodies()[b].body().positions()));
  }
  twin->validate();
  EXPECT_GT(contacts, 20u);
  EXPECT_GT(world.body_counts().regions, 0u);
}

TEST(SavedState, AWorldGoesOnAsIfItHadNotStopped2) { go_on<2>(test::rooms<2>({4, 3}, {5})); }
TEST(SavedState, AWorldGoesOnAsIfItHadNotStopped3) { go_on<3>(test::rooms<3>({4, 3, 3}, {5, 17})); }

TEST(SavedState, BytesThatDoNotFitAreRefused) {
  const Snapshot<3> snapshot = test::rooms<3>({4, 3, 3}, {5, 17}), other = test::rooms<3>({4, 3, 3}, {0});
  const Scene<3> scene = scene_of_all<3>();
  const Body_soup<3> body = small_body(std::integral_constant<int, 3>());
  const Bytes bytes = bytes_of(World<3>(snapshot, scene, {body, body, body}));
  const auto is_refused = [&](const Snapshot<3>& in, const Scene<3>& of, const Bytes& changed) {
    try {
      restored(in, of, changed);
    } catch (const Error& error) {
      return error.code() == Error_code::input;
    }
    return false;
  };
  EXPECT_FALSE(is_refused(snapshot, scene, bytes));
  EXPECT_TRUE(is_refused(other, scene, bytes));
  Scene<3> without = scene;
  without.catheter.reset();
  EXPECT_TRUE(is_refused(snapshot, without, bytes));
  without = scene;
  without.bodies.pop_back();
  EXPECT_TRUE(is_refused(snapshot, without, bytes));
  for (std::size_t size = 0; size < bytes.size(); size += 97)
    EXPECT_TRUE(
        is_refused(snapshot, scene, Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))))
        << size;
}

/// Words are changed: what is restored can go on, if only to an Error. Bodies have checksums of their own.
TEST(SavedState, ForgedWordsAreRefusedOrUsed) {
  const Snapshot<3> snapshot = test::rooms<3>({4, 3, 3}, {5, 17});
  const Scene<3> scene = scene_of_all<3>();
  const Body_soup<3> body = small_body(std::integral_constant<int, 3>());
  World<3> world(snapshot, scene, {body, body, body});
  for (int step = 0; step < 5; ++step) world.step();
  const Bytes bytes = bytes_of(world);
  int refused = 0, used = 0;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 52)
    for (const std::uint32_t value : {0u, 1u, 7u, 1u << 31, ~0u}) {
      Bytes changed = bytes;
      std::memcpy(changed.data() + i, &value, sizeof value);
      try {
        World<3> other = restored(snapshot, scene, changed);
        ++used;
        other.step();
      } catch (const Error&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 100);
  EXPECT_GT(used, 100);
}

}  // namespace
}  // namespace cellwalk
