// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves that are asked about, or not made, change nothing for what is not listed: planes are withdrawn and
// made anew, the same as before.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "reshape/grids.h"
#include "reshape/reshape_world.h"

namespace cellwalk {
namespace {

/// All that certifies.
template <int D>
std::vector<unsigned char> certificates(const Snapshot<D>& snapshot) {
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    const auto append = [&](const auto* from, std::size_t count) {
      const std::size_t end = bytes.size(), size = count * sizeof(*from);
      bytes.resize(end + size);
      std::memcpy(bytes.data() + end, from, size);
    };
    append(snapshot.blocks(c), snapshot.block_count(c));
    append(snapshot.links(c), 4 * snapshot.block_count(c));
  }
  return bytes;
}

template <int D>
void ask_only(std::uint64_t number, bool generic) {
  test::Reshape_world<D> world(number, generic);
  world.populate(12, 8);
  const auto before = certificates(world.snapshot);
  const std::uint64_t epoch = world.snapshot.epoch(), geometry = world.snapshot.geometry_epoch();
  const std::size_t uncertified = world.snapshot.uncertified_planes();
  const Locator<D> locator(world.snapshot);
  {
    // The bodies are not listed; what is, holds the walls that meet it.
    Reshaping<D> reshaping(world.environment, {{}, {world.particles}}, {.at_contact = At_contact::hold});
    for (int i = 0; i < 30; ++i) {
      const std::uint32_t v = world.vertex();
      const Point<D> target = world.target(v);
      if (reshaping.test_move(v, target).end != Move_end::reached) reshaping.move(v, target);
    }
    EXPECT_GT(reshaping.counts().moves, 30u);
    EXPECT_EQ(reshaping.counts().made, 0u);
  }
  EXPECT_EQ(certificates(world.snapshot), before) << world.name();
  EXPECT_EQ(world.snapshot.uncertified_planes(), uncertified);
  EXPECT_EQ(world.snapshot.epoch(), epoch);
  EXPECT_EQ(world.snapshot.geometry_epoch(), geometry);
  EXPECT_NO_THROW(locator.particles_at(world.particles[0].position));
  Body_counts counts;
  for (const auto& body : world.bodies) EXPECT_NO_THROW(body->refresh(counts)) << world.name();

  Reshaping<D> reshaping(world.environment, {{}, {world.particles}});
  while (reshaping.counts().made == 0) {
    const std::uint32_t v = world.vertex();
    reshaping.move(v, world.target(v));
  }
  reshaping.finish();
  EXPECT_GT(world.snapshot.epoch(), epoch);
  EXPECT_THROW(locator.particles_at(world.particles[0].position), Error);
}

TEST(NothingMade, ChangesNothingIn2D) {
  for (std::uint64_t number = 0; number < 10; ++number) ask_only<2>(number, number % 2 == 0);
}
TEST(NothingMade, ChangesNothingIn3D) {
  for (std::uint64_t number = 0; number < 6; ++number) ask_only<3>(number, number % 2 == 0);
}

TEST(NothingMade, LetsABodyGoOnThatIsNotListed) {
  Environment<3> environment = test::simplex_grid<3>(4);
  test::add_membrane<3>(environment, 2);
  const std::uint32_t vertex = test::point_at<3>(environment, {2, 2, 2});
  const Locator<3> locator(environment.snapshot());
  const auto edge = [&](double height) {
    return Body<3>(environment.snapshot(), locator,
                   {{{1.5, 2.125, height}, {2.5, 2.125, height}}, {{0, 1}}, {}});
  };
  Body<3> listed = edge(2.125), other = edge(2.25);
  const auto step = [&](double height) {
    Step_report<3> report;
    Body_counts counts;
    other.step(std::vector<Point<3>>{{1.5, 2.125, height}, {2.5, 2.125, height}}, {}, report, counts);
  };
  Reshaping<3> reshaping(environment, {{&listed}, {}}, {.at_contact = At_contact::hold});
  EXPECT_EQ(reshaping.test_move(vertex, {2, 2, 2.0625}).end, Move_end::reached);
  EXPECT_EQ(reshaping.move(vertex, {2, 2, 2.5}).end, Move_end::contact);
  reshaping.finish();
  EXPECT_NO_THROW(step(2.5));
  Reshaping<3> again(environment, {{&listed}, {}}, {.at_contact = At_contact::hold});
  EXPECT_EQ(again.move(vertex, {2, 2, 2.0625}).end, Move_end::reached);
  again.finish();
  EXPECT_THROW(step(2.25), Error);
}

}  // namespace
}  // namespace cellwalk
