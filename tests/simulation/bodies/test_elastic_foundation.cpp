// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that yield to a body which is pressed against them, and recover.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/simulation/elastic_foundation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cellwalk {
namespace {

/// A room of side 4 with a small body that is guided into its ceiling, and out of it again.
template <int D>
struct Pressed_room {
  explicit Pressed_room(const Soft_walls& soft, std::span<const Scene_shape<D>> fixed = {})
      : environment(Environment<D>::build(grid(), {.keep_map = false})),
        world(environment.snapshot(), scene(), {shape()}, {}),
        foundation(environment.snapshot(), soft, fixed) {}

  static Cell_soup<D> grid() {
    Simplex_grid_options<D> options;
    options.cells.fill(4);
    if constexpr (D == 2)
      return triangle_grid(options);
    else
      return tetrahedral_grid(options);
  }
  static Body_soup<D> shape() {
    Body_soup<D> soup;
    soup.points.resize(2);
    soup.points[1][0] = 0.5;
    soup.edges = {{0, 1}};
    return soup;
  }
  static Scene<D> scene() {
    Scene<D> result;
    result.time_step = 1;
    Body_start<D> start;
    Point<D> low, high;
    low.fill(1.7);
    high.fill(1.7);
    high[D - 1] = 4.5;
    start.guided = Guided_motion<D>{{low, high, low}, 0.25};
    start.placement.position = low;
    result.bodies.push_back(start);
    return result;
  }

  void step() {
    foundation.press(world);
    const auto moves = foundation.targets();
    const auto report = world.move_walls(environment, moves, {.at_contact = At_contact::stop}, counts);
    foundation.follow(moves, report);
    world.step();
    world.validate();
    ASSERT_NO_THROW(environment.certify());
  }
  double highest() const {
    double result = 0;
    for (const Point<D>& x : environment.snapshot().points()) result = std::max(result, x[D - 1]);
    return result;
  }

  Environment<D> environment;
  World<D> world;
  Elastic_foundation<D> foundation;
  Reshape_counts counts;
};

template <int D>
void yield_and_recover() {
  Pressed_room<D> room({.compliance = 3, .recovery = 0.25, .spread = 1});
  double highest = 4, most = 0;
  for (int i = 0; i < 14; ++i) {
    room.step();
    highest = std::max(highest, room.highest());
    most = std::max(most, room.foundation.largest_yield());
    EXPECT_GE(room.foundation.force() * 3, room.foundation.largest_yield());
  }
  EXPECT_GT(most, 0.1) << "pressed by half a unit";
  EXPECT_LT(most, 0.7);
  EXPECT_NEAR(highest, 4 + most, 0.02) << "the ceiling went up";
  for (int i = 0; i < 200; ++i) room.step();
  EXPECT_EQ(room.highest(), 4) << "and came back, to the bit";
  EXPECT_EQ(room.foundation.largest_yield(), 0);
  EXPECT_EQ(room.foundation.yielding_count(), 0u);
}

TEST(ElasticFoundation, YieldsAndRecovers) {
  yield_and_recover<2>();
  yield_and_recover<3>();
}

TEST(ElasticFoundation, StifferWallsYieldLess) {
  std::vector<double> most;
  for (const double compliance : {0.125, 1.0, 8.0}) {
    Pressed_room<3> room({.compliance = compliance, .recovery = 0.25, .spread = 1});
    double of_this = 0;
    for (int i = 0; i < 14; ++i) {
      room.step();
      of_this = std::max(of_this, room.foundation.largest_yield());
    }
    most.push_back(of_this);
  }
  EXPECT_LT(2 * most[0], most[1]);
  EXPECT_LT(most[1], most[2]);
}

TEST(ElasticFoundation, WhatIsFixedDoesNotYield) {
  const std::vector<Scene_shape<3>> all{Scene_ball<3>{{2, 2, 2}, 9}};
  Pressed_room<3> room({}, all);
  for (int i = 0; i < 14; ++i) room.step();
  EXPECT_EQ(room.highest(), 4);
  EXPECT_EQ(room.counts.moves, 0u);
}

TEST(ElasticFoundation, WhatIsInTheWayIsNoYield) {
  Pressed_room<2> room({.compliance = 8, .recovery = 0.5, .spread = 0});
  // The body is held up by its guide while the ceiling recovers fast: it comes down on the body, and stops.
  bool has_stopped = false;
  for (int i = 0; i < 14; ++i) {
    room.step();
    has_stopped |= room.counts.hits > 0;
    for (std::uint32_t v = 0; v < room.environment.snapshot().points().size(); ++v) {
      const Vector<2> yield = room.foundation.yield(v);
      EXPECT_LT(std::abs(yield[0]), 0.3);
      EXPECT_GT(yield[1], -1e-12) << "no wall is drawn into the room";
    }
  }
  EXPECT_TRUE(has_stopped);
}

}  // namespace
}  // namespace cellwalk
