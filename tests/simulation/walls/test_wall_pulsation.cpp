// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that pulsate, by themselves and in a world.
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/generators/implicit.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/wall_pulsation.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {
namespace {

/// A cube (2D: a square) of side 4 in simplices of size 1.
template <int D>
Environment<D> room(bool keep_map = false) {
  Simplex_grid_options<D> grid;
  grid.cells.fill(4);
  if constexpr (D == 2)
    return Environment<D>::build(triangle_grid(grid), {.keep_map = keep_map});
  else
    return Environment<D>::build(tetrahedral_grid(grid), {.keep_map = keep_map});
}

template <int D>
std::map<std::uint32_t, Point<D>> by_point(const std::vector<Vertex_move<D>>& moves) {
  std::map<std::uint32_t, Point<D>> result;
  for (const Vertex_move<D>& move : moves) result[move.point] = move.target;
  EXPECT_EQ(result.size(), moves.size()) << "each point once";
  return result;
}

/// How many sides of the room hold a point.
int sides_at(std::span<const double> x) {
  return static_cast<int>(std::ranges::count_if(x, [](double c) { return c == 0 || c == 4; }));
}

TEST(WallPulsation, MovesWallsAlongTheirNormalsAndTheRestLess) {
  const Environment<3> environment = room<3>();
  const Snapshot<3>& snapshot = environment.snapshot();
  const Wall_pulsation<3> pulsation(snapshot, {.amplitude = 0.25, .period = 2, .wave = {}}, {});
  // A quarter of a period after the first.
  const auto targets = by_point(pulsation.targets(2.5));
  for (std::uint32_t i = 0; i < snapshot.points().size(); ++i) {
    const Point<3>& x = snapshot.point(i);
    const Point<3> target = targets.contains(i) ? targets.at(i) : x;
    const Vector<3> way = target - x;
    if (sides_at(x) == 0) {
      EXPECT_LT(length(way), 0.25);
      if (x == Point<3>{2, 2, 2}) {
        EXPECT_LT(length(way), 0.01) << "the middle stays: walls around it go all ways";
      }
    } else {
      EXPECT_NEAR(length(way), 0.25, 1e-15);
      for (std::size_t k = 0; k < 3; ++k) {
        const double outwards = x[k] == 0 ? -way[k] : way[k];
        if (x[k] == 0 || x[k] == 4) {
          EXPECT_GT(outwards, 0);
        } else if (sides_at(x) == 1) {
          EXPECT_EQ(way[k], 0) << "along the normal";
        }
      }
    }
  }
}

TEST(WallPulsation, BeginsAtRestAndIsPeriodic) {
  const Environment<2> environment = room<2>();
  const Wall_pulsation<2> pulsation(environment.snapshot(),
                                    {.amplitude = 0.25, .period = 2, .wave = Vector<2>{8, 0}}, {});
  for (const Vertex_move<2>& move : pulsation.targets(0))
    EXPECT_EQ(move.target, environment.snapshot().point(move.point));
  const auto one = by_point(pulsation.targets(2.75)), later = by_point(pulsation.targets(4.75));
  for (const auto& [point, x] : one) {
    EXPECT_NEAR(x[0], later.at(point)[0], 1e-14);
    EXPECT_NEAR(x[1], later.at(point)[1], 1e-14);
  }
  // The wave: on the side y = 0, displacements follow the sine, delayed by x / 8 turns.
  for (const auto& [point, x] : one) {
    const Point<2>& start = environment.snapshot().point(point);
    if (start[1] != 0 || sides_at(start) != 1) continue;
    EXPECT_NEAR(start[1] - x[1], 0.25 * std::sin(2 * std::numbers::pi * (2.75 / 2 - start[0] / 8)), 1e-15);
  }
}

TEST(WallPulsation, FadesTowardWhatIsFixed) {
  const Environment<3> environment = room<3>();
  const std::vector<Scene_shape<3>> fixed{Scene_box<3>{{-9, -9, -9}, {9, 9, 1}},
                                          Scene_ball<3>{{4, 4, 4}, 0.5}};
  const Wall_pulsation<3> pulsation(environment.snapshot(), {.amplitude = 0.125, .period = 1, .wave = {}},
                                    fixed);
  const auto targets = by_point(pulsation.targets(1.25));
  const auto way_of = [&](const Point<3>& x) {
    for (std::uint32_t i = 0; i < environment.snapshot().points().size(); ++i)
      if (environment.snapshot().point(i) == x) return targets.contains(i) ? length(targets.at(i) - x) : 0;
    ADD_FAILURE() << "no such point";
    return 0.0;
  };
  for (const auto& [point, x] : targets) EXPECT_GT(environment.snapshot().point(point)[2], 1);
  EXPECT_NEAR(way_of({0, 2, 3}), 0.125, 1e-15) << "two away: ten amplitudes are 1.25";
  EXPECT_NEAR(way_of({0, 2, 2}), 0.125 / 1.25, 1e-15) << "one away";
  EXPECT_EQ(way_of({4, 4, 4}), 0);
}

TEST(WallPulsation, HoldsTheOuterBoundaryOfTissue) {
  // The middle square of nine is free, the others are solid.
  Simplex_grid_options<2> grid;
  grid.cells.fill(3);
  Cell_soup<2> soup = triangle_grid(grid);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const std::uint32_t f = soup.cell_begin[c];
    Point<2> sum{};
    for (std::uint32_t k = f; k < soup.cell_begin[c + 1]; ++k) sum = sum + soup.points[soup.facet(k)[0]];
    const Point<2> middle = (1.0 / (soup.cell_begin[c + 1] - f)) * sum;
    soup.solid[c] = !(middle[0] > 1 && middle[0] < 2 && middle[1] > 1 && middle[1] < 2);
  }
  const auto environment = Environment<2>::build(soup);
  const Wall_pulsation<2> pulsation(environment.snapshot(), {.amplitude = 0.25, .period = 1, .wave = {}}, {});
  std::size_t at_wall = 0;
  for (const Vertex_move<2>& move : pulsation.targets(1.25)) {
    const Point<2>& x = environment.snapshot().point(move.point);
    EXPECT_TRUE(std::ranges::all_of(x, [](double c) { return c > 0 && c < 3; })) << "the boundary stays";
    ++at_wall;
  }
  EXPECT_EQ(at_wall, 4u);
}

/// A cube (2D: a square) of side 2 with one point inside, which lies near a side.
template <int D>
Environment<D> lopsided_room() {
  Simplex_grid_options<D> grid;
  grid.cells.fill(2);
  Cell_soup<D> soup;
  if constexpr (D == 2)
    soup = triangle_grid(grid);
  else
    soup = tetrahedral_grid(grid);
  for (Point<D>& x : soup.points)
    if (std::ranges::all_of(x, [](double c) { return c == 1; })) x[D - 1] = 0.0625;
  return Environment<D>::build(std::move(soup));
}

/// Three beats of 32 steps.
/// \return how many moves of points a cell ended
template <int D>
std::size_t beat_alone(Environment<D>& environment, const Wall_pulsation<D>& pulsation) {
  std::size_t ends = 0;
  std::map<std::uint32_t, Point<D>> before;
  for (int step = 1; step <= 96; ++step) {
    Reshaping<D> reshaping(environment, {}, {});
    const auto moves = pulsation.targets(step / 32.0);
    const Move_report<D> report = reshaping.move(moves);
    reshaping.finish();
    for (const Vertex_result<D>& result : report.short_of_target) ends += result.end == Move_end::cell;
    if (step != 64 && step != 96) continue;
    for (const Vertex_move<D>& move : moves) {
      const Point<D>& x = environment.snapshot().point(move.point);
      if (const auto known = before.find(move.point); known != before.end()) {
        EXPECT_NEAR(length(x - known->second), 0, ends == 0 ? 1e-12 : 2) << "nothing drifts";
      }
      before[move.point] = x;
    }
  }
  EXPECT_NO_THROW(environment.certify());
  return ends;
}

template <int D>
void expect_smoothing_unlocks() {
  Pulsation<D> motion{.amplitude = 0.25, .period = 1, .wave = {}};
  Environment<D> locked = lopsided_room<D>(), smooth = lopsided_room<D>();
  const Wall_pulsation<D> plain(locked.snapshot(), motion, {});
  motion.smooth = 20;
  motion.quality_floor = 0.6;
  const Wall_pulsation<D> better(smooth.snapshot(), motion, {});
  // Walls go the same way.
  const auto of_plain = by_point(plain.targets(1.25)), of_better = by_point(better.targets(1.25));
  for (const auto& [point, x] : of_plain)
    if (locked.snapshot().point(point)[D - 1] != 0.0625) {
      EXPECT_EQ(of_better.at(point), x);
    }
  EXPECT_GT(beat_alone(locked, plain), 20u);
  EXPECT_EQ(beat_alone(smooth, better), 0u);
}

TEST(WallPulsation, GoesOnWithSmoothingWhereItLocksWithout) {
  expect_smoothing_unlocks<2>();
  expect_smoothing_unlocks<3>();
}

// The point inside goes on the parabola through its places for no motion and for both ends of the motion.
template <int D>
void expect_parabola() {
  const Environment<D> environment = lopsided_room<D>();
  Pulsation<D> motion{.amplitude = 0.25, .period = 1, .wave = {}};
  motion.smooth = 20;
  motion.quality_floor = 0.9;
  // One side stands, so that the others do not only scale the room.
  Scene_box<D> side;
  side.lower.fill(-9);
  side.upper.fill(9);
  side.upper[D - 1] = 0.03125;
  const std::vector<Scene_shape<D>> fixed{side};
  const Wall_pulsation<D> pulsation(environment.snapshot(), motion, fixed);
  const auto at = [&](double time) { return by_point(pulsation.targets(time)); };
  const auto rest = at(2), out = at(1.25), in = at(1.75), half = at(1 + 1.0 / 12);
  double most = 0;
  for (const auto& [point, x] : rest) {
    const Vector<D> bend = 0.5 * ((out.at(point) - x) + (in.at(point) - x));
    const Vector<D> way = 0.5 * (out.at(point) - in.at(point));
    EXPECT_NEAR(length(half.at(point) - (x + 0.5 * way + 0.25 * bend)), 0, 1e-12);
    most = std::max(most, length(bend));
  }
  EXPECT_GT(most, 1e-3) << "it is no line";
}

TEST(WallPulsation, SmoothedPointsGoOnParabolas) {
  expect_parabola<2>();
  expect_parabola<3>();
}

/// A ball of radius 1 with a rough surface, cut from a lattice.
Environment<3> rough_ball() {
  Implicit_shape ball;
  ball.depth = [](const Point<3>& p) { return 1 - length(p); };
  ball.low = {-1, -1, -1}, ball.high = {1, 1, 1};
  ball.cell_size = 0.25;
  Cell_soup<3> soup = fill_implicit(ball);
  Random random(1);
  for (Point<3>& x : soup.points)
    if (length(x) > 0.99)
      for (double& c : x) c += random.real(-0.02, 0.02);
  return Environment<3>::build(std::move(soup));
}

TEST(WallPulsation, GoesFurtherWhereDirectionsAreEven) {
  Pulsation<3> motion{.amplitude = 0.3, .period = 1, .wave = {}};
  std::array<std::size_t, 2> ends{};
  for (const std::uint32_t even : {0u, 10u}) {
    Environment<3> environment = rough_ball();
    motion.even = even;
    const Wall_pulsation<3> pulsation(environment.snapshot(), motion, {});
    for (const Vertex_move<3>& move : pulsation.targets(1.25)) {
      const Point<3>& x = environment.snapshot().point(move.point);
      if (length(x) < 0.96) continue;  // inside
      const Vector<3> way = move.target - x;
      EXPECT_NEAR(length(way), 0.3, 1e-14) << "as far as without";
      EXPECT_GT(dot(way, normalized(x - Point<3>{})), 0.2) << "and outwards";
    }
    ends[even > 0] = beat_alone(environment, pulsation);
  }
  EXPECT_GT(ends[0], 100u);
  EXPECT_EQ(ends[1], 0u);
}

TEST(WallPulsation, SmoothsNothingAboveTheFloorOrInFixedParts) {
  Environment<3> environment = lopsided_room<3>();
  Pulsation<3> motion{.amplitude = 0.25, .period = 1, .wave = {}};
  const auto plain = by_point(Wall_pulsation<3>(environment.snapshot(), motion, {}).targets(1.25));
  motion.smooth = 20;
  motion.quality_floor = 0;
  motion.amplitude = 0.01;
  const auto above = by_point(Wall_pulsation<3>(environment.snapshot(), motion, {}).targets(0));
  for (const auto& [point, x] : above) EXPECT_EQ(x, environment.snapshot().point(point));
  motion.quality_floor = 1;
  const std::vector<Scene_shape<3>> all{Scene_box<3>{{-9, -9, -9}, {9, 9, 9}}};
  EXPECT_TRUE(Wall_pulsation<3>(environment.snapshot(), motion, all).targets(1.25).empty());
  EXPECT_FALSE(plain.empty());
}

TEST(WallPulsation, BeatsInTissueForGoodAndStaysInItsBox) {
  Vessel_options options;
  options.generations = 0;
  options.length = 3;
  options.cell_size = 0.4;
  options.tissue = 0.5;
  Environment<3> environment = Environment<3>::build(branching_vessel(options));
  const Snapshot<3>& snapshot = environment.snapshot();
  std::map<std::uint32_t, Point<3>> outer;
  std::size_t inside = 0;
  for (std::size_t c = 0; c < snapshot.cell_count(); ++c)
    for (std::size_t f = 0; f < 4; ++f) {
      const Half_facet facet = snapshot.half_facet(snapshot.cell(c), f);
      if (snapshot.neighbour(facet) != Cell::none) continue;
      EXPECT_TRUE(snapshot.is_solid(snapshot.cell(c))) << "no wall is on the boundary";
      for (const std::uint32_t v : snapshot.loop(facet)) outer[v] = snapshot.point(v);
    }
  const Wall_pulsation<3> pulsation(snapshot, {.amplitude = 0.1, .period = 1, .wave = {}}, {});
  for (const Vertex_move<3>& move : pulsation.targets(1.25)) {
    EXPECT_FALSE(outer.contains(move.point));
    inside += length(move.target - snapshot.point(move.point)) > 0.09;
  }
  EXPECT_GT(inside, 100u);
  EXPECT_EQ(beat_alone(environment, pulsation), 0u);
  for (const auto& [point, x] : outer) EXPECT_EQ(snapshot.point(point), x);
}

/// Soft and rigid bodies, a catheter and particles in a room that beats: all is pushed, nothing is lost.
template <int D>
void beat(bool push, std::uint64_t* hits = nullptr) {
  Environment<D> environment = room<D>();
  Scene<D> scene;
  scene.time_step = 0.05;
  scene.particles.push_back(Particle_cloud{30, 2, 5});
  Body_start<D> start;
  start.cloud = Particle_cloud{4, 1, 3};
  Body_soup<D> shape;
  for (int k = 0; k <= D; ++k) {
    Point<D> x{};
    if (k > 0) x[static_cast<std::size_t>(k - 1)] = 0.75;
    shape.points.push_back(x);
    for (int i = 0; i < k; ++i)
      shape.edges.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)});
  }
  scene.bodies.push_back(start);
  Catheter<D> catheter;
  catheter.spacing = 0.25;
  catheter.particles = 12;
  Point<D> entry, far;
  entry.fill(1.5);
  far.fill(2.125);
  far[0] = 9;
  catheter.path = {entry, far};
  scene.catheter = catheter;
  World<D> world(environment.snapshot(), scene, {shape}, {});
  const Wall_pulsation<D> pulsation(environment.snapshot(), {.amplitude = 0.3, .period = 1, .wave = {}}, {});
  Reshape_counts counts;
  std::size_t met = 0, short_of_target = 0;
  for (int i = 1; i <= 60; ++i) {
    const auto report = world.move_walls(environment, pulsation.targets(scene.time_step * i),
                                         {.at_contact = push ? At_contact::push : At_contact::stop}, counts);
    met += report.hits.size();
    short_of_target += report.short_of_target.size();
    world.validate();
    world.step();
    world.validate();
    ASSERT_NO_THROW(environment.certify());
  }
  EXPECT_GT(met, 20u);
  EXPECT_EQ(counts.moves > 0, true);
  if (push) {
    EXPECT_GT(counts.pushes, 20u);
  } else {
    EXPECT_EQ(counts.pushes, 0u);
    EXPECT_GT(short_of_target, 10u);
  }
  if (hits) *hits = met;
}

TEST(WallPulsation, BeatsAmongEverythingAndPushesIt) {
  beat<2>(true);
  beat<3>(true);
}

TEST(WallPulsation, BeatsAmongEverythingAndStops) {
  beat<2>(false);
  beat<3>(false);
}

TEST(WallPulsation, GivesTheSameEachTime) {
  std::uint64_t one = 0, other = 0;
  beat<3>(true, &one);
  beat<3>(true, &other);
  EXPECT_EQ(one, other);
}

TEST(World, MovesNoWallsOfOtherEnvironments) {
  Environment<3> environment = room<3>(), other = room<3>();
  Scene<3> scene;
  scene.particles.push_back(Particle_cloud{3, 1, 1});
  World<3> world(environment.snapshot(), scene);
  Reshape_counts counts;
  EXPECT_THROW(world.move_walls(other, {}, {}, counts), Error);
  EXPECT_NO_THROW(world.move_walls(environment, {}, {}, counts));
  environment.move_vertex(0, {-0.25, -0.25, -0.25});
  EXPECT_THROW(world.move_walls(environment, {}, {}, counts), Error) << "it was edited behind its back";
}

}  // namespace
}  // namespace cellwalk
