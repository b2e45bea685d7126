// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>

#include <gtest/gtest.h>

#include "handovers.h"

namespace cellwalk::scaling {
namespace {

/// A row of cubes, which the curve follows from one end to the other or back.
Environment<3> row_of_cubes(std::uint32_t count) {
  Grid_options<3> options;
  options.cells = {count, 1, 1};
  return Environment<3>::build(hex_grid(options));
}

TEST(Ranges, AreContiguousAndEven) {
  const auto environment = row_of_cubes(8);
  const Ranges ranges(environment.snapshot(), 4);
  std::vector<int> cells(4);
  for (std::size_t i = 0; i < 8; ++i) ++cells[ranges.owner(environment.snapshot().cell(i))];
  EXPECT_EQ(cells, (std::vector<int>{2, 2, 2, 2}));
  // Along a row each rank sees one cell of each rank beside it.
  EXPECT_EQ(ranges.ghosts(), 6u);
  EXPECT_EQ(ranges.most_neighbours(), 2u);
}

TEST(Handovers, OfARodThatMovesAlongARow) {
  const auto environment = row_of_cubes(8);
  Scene<3> scene;
  Body_start<3> start;
  start.placement.position = {0.25, 0.5, 0.5};
  start.velocity = {1, 0, 0};
  scene.bodies.push_back(start);
  scene.particles.emplace_back(Particle_start<3>{{0.5, 0.5, 0.25}, {0, 0, 0}});
  scene.time_step = 0.5;
  Body_soup<3> rod;
  rod.points = {{0, 0, 0}, {2.5, 0, 0}};
  rod.edges = {{0, 1}};
  World<3> world(environment.snapshot(), scene, {rod});
  Counter counter(environment.snapshot(), 4);
  // The rod lies from 0.25 to 2.75, then from 0.75, 1.25, 1.75 and 2.25 on; ranks change at 2, 4 and 6.
  for (int step = 0; step <= 4; ++step) {
    if (step > 0) world.step();
    world.validate();
    counter.count(world);
  }
  const Handovers& sum = counter.sum();
  EXPECT_EQ(sum.vertices, 15u);
  EXPECT_EQ(sum.bodies, 5u);
  EXPECT_EQ(sum.edges, 5u);
  EXPECT_EQ(sum.moved, 2u) << "the tip at 4, the other end at 2";
  EXPECT_EQ(sum.parted, 5u);
  EXPECT_EQ(sum.parted_bodies, 5u);
  EXPECT_EQ(sum.crossings, 1u + 1 + 1 + 2 + 1);
  EXPECT_EQ(sum.longest, 10u) << "both ends wait, each time";
  // The particle and the end share a rank until the last step; then each has one.
  EXPECT_EQ(sum.most_vertices, 2u + 2 + 2 + 2 + 1);
  EXPECT_EQ(sum.most_received, 1u + 1 + 1 + 2 + 1);
}

}  // namespace
}  // namespace cellwalk::scaling
