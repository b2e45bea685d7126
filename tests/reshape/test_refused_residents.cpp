// SPDX-License-Identifier: LGPL-3.0-or-later
// Residents that are none, and moves of many vertices one of which cannot be asked for, are refused before
// anything changes.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 endless = std::numeric_limits<double>::infinity();

template <int D>
Point<D> diagonal(double x) {
  Point<D> p;
  p.fill(x);
  return p;
}

template <int D>
Body<D> segment(const Snapshot<D>& snapshot, const Locator<D>& locator) {
  return Body<D>(snapshot, locator, {{diagonal<D>(0.5), diagonal<D>(1.5)}, {{0, 1}}, {}});
}

template <int D>
void expect_residents_are_refused() {
  Environment<D> environment = test::simplex_grid<D>(4);
  const Snapshot<D>& snapshot = environment.snapshot();
  const Locator<D> locator(snapshot);
  Body<D> body = segment<D>(snapshot, locator);
  int refused = 0;
  const auto expect_refused = [&](const Residents<D>& residents, const std::string& said) {
    try {
      Reshaping<D> reshaping(environment, residents);
      ADD_FAILURE() << said;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::usage);
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
      ++refused;
    }
  };
  for (std::size_t count = 1; count <= 6; ++count)
    for (std::size_t null = 0; null < count; ++null) {
      std::vector<Body<D>> bodies(count, body);
      Residents<D> residents;
      for (Body<D>& b : bodies) residents.bodies.push_back(&b);
      residents.bodies[null] = nullptr;
      expect_refused(residents, "a body listed is null");
    }
  const Particle<D> good = locator.particle_at(diagonal<D>(2.25)).value();
  for (std::size_t count = 1; count <= 4; ++count)
    for (std::size_t bad = 0; bad < count; ++bad)
      for (int what = 0; what < 3 + 3 * D; ++what) {
        std::vector<Particle<D>> particles(count, good);
        if (what < 3)
          particles[bad].cell = Cell::none;
        else
          particles[bad].position[static_cast<std::size_t>((what - 3) % D)] = what - 3 < D       ? no_number
                                                                              : what - 3 < 2 * D ? endless
                                                                                                 : -endless;
        expect_refused({{}, {particles}}, "particle " + std::to_string(bad) + " of those listed");
      }
  EXPECT_EQ(refused, 21 + 10 * (3 + 3 * D));
  Body_counts counts;
  EXPECT_NO_THROW(body.move_vertex(0, diagonal<D>(0.625), {}, counts)) << "nothing was edited";
  EXPECT_NO_THROW(environment.certify());
}

TEST(RefusedResidents, NullBodiesAndParticlesWithoutAPlace2) { expect_residents_are_refused<2>(); }
TEST(RefusedResidents, NullBodiesAndParticlesWithoutAPlace3) { expect_residents_are_refused<3>(); }

template <int D>
void expect_moves_are_refused() {
  Environment<D> environment = test::simplex_grid<D>(4);
  const Snapshot<D>& snapshot = environment.snapshot();
  const std::vector<Point<D>> before(snapshot.points().begin(), snapshot.points().end());
  const auto count = static_cast<std::uint32_t>(before.size());
  const std::uint64_t epoch = snapshot.epoch();
  Reshaping<D> reshaping(environment, {});
  int refused = 0;
  for (std::uint32_t bad = 0; bad < 16; ++bad)
    for (int what = 0; what < 4; ++what) {
      std::vector<Vertex_move<D>> moves;
      for (std::uint32_t v = 0; v < 16; ++v) moves.push_back({v, before[v] + diagonal<D>(0x1p-10)});
      double& coordinate = moves[bad].target[bad % D];
      if (what == 0) coordinate = no_number;
      if (what == 1) coordinate = endless;
      if (what == 2) coordinate = -endless;
      if (what == 3) moves[bad].point = count + bad;
      try {
        reshaping.move(moves);
        ADD_FAILURE() << bad << ' ' << what;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), what == 3 ? Error_code::usage : Error_code::input);
        ++refused;
      }
      EXPECT_THROW(reshaping.move(moves[bad].point, moves[bad].target), Error);
      EXPECT_THROW(reshaping.test_move(moves[bad].point, moves[bad].target), Error);
    }
  EXPECT_EQ(refused, 64);
  EXPECT_TRUE(std::ranges::equal(snapshot.points(), before));
  EXPECT_EQ(snapshot.epoch(), epoch);
}

TEST(RefusedMoves, OfManyVerticesChangeNothing2) { expect_moves_are_refused<2>(); }
TEST(RefusedMoves, OfManyVerticesChangeNothing3) { expect_moves_are_refused<3>(); }

}  // namespace
}  // namespace cellwalk
