// SPDX-License-Identifier: LGPL-3.0-or-later
// Location against the oracle: on facets, edges and vertices, outside, in solid cells, on membranes and
// pinches.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <array>
#include <iostream>

#include "walk/oracle_trial.h"

namespace cellwalk::oracle {
namespace {

constexpr std::size_t points_in_ci = 20'000;
constexpr std::size_t points_per_world = 50;

struct Located {
  std::size_t points = 0, outside = 0, solid = 0, one_side = 0, two_sides = 0, more_sides = 0;
  std::array<std::size_t, 4> by_dimension{};
  std::size_t most_cells = 0;
};

template <int D>
void compare(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Locator<D>& locator,
             const Point<D>& p, Located& tally) {
  const Place place = oracle.place(p);
  const Location<D> location = locator.locate(p);
  const Particle<D> particle = locator.particle_at(p).value_or(Particle<D>{p});
  ++tally.points;
  std::vector<std::uint32_t> cells;
  for (Cell c : location.cells) cells.push_back(snapshot.index(c));
  for (std::size_t i = 1; i < cells.size(); ++i)
    ASSERT_TRUE(location.side_of_cell[i - 1] < location.side_of_cell[i] ||
                (location.side_of_cell[i - 1] == location.side_of_cell[i] && cells[i - 1] < cells[i]))
        << "side by side, each side by index";
  const std::uint32_t first = cells.empty() ? 0 : cells.front();
  std::sort(cells.begin(), cells.end());
  ASSERT_EQ(cells, place.free_cells) << "all free cells";
  ASSERT_EQ(particle.position, p);
  ASSERT_EQ(particle.cell, location.cell);
  if (place.free_cells.empty()) {
    ASSERT_EQ(location.cell, Cell::none);
    ASSERT_EQ(location.status, place.solid_cells.empty() ? Location_status::outside : Location_status::solid);
    ++(place.solid_cells.empty() ? tally.outside : tally.solid);
    return;
  }
  ASSERT_EQ(location.status, Location_status::free);
  ASSERT_EQ(snapshot.index(location.cell), first);
  const std::vector<Particle<D>> particles = locator.particles_at(p);
  ASSERT_EQ(particles.size(), static_cast<std::size_t>(place.sides));
  ASSERT_EQ(particles.front().cell, particle.cell);
  const auto number =
      std::find(place.free_cells.begin(), place.free_cells.end(), first) - place.free_cells.begin();
  const int dimension = place.dimensions[static_cast<std::size_t>(number)];
  ASSERT_EQ(location.dimension, dimension);
  ASSERT_EQ(particle.dimension, dimension);
  ASSERT_EQ(location.sides.size(), static_cast<std::size_t>(place.sides));
  ++(place.sides == 1 ? tally.one_side : place.sides == 2 ? tally.two_sides : tally.more_sides);
  ++tally.by_dimension[place.dimension];
  tally.most_cells = std::max(tally.most_cells, cells.size());
}

template <int D>
Located run(std::uint64_t seed) {
  Located tally;
  const std::size_t points = scaled_count(points_in_ci);
  for (std::uint64_t i = seed; tally.points < points && !::testing::Test::HasFatalFailure(); ++i) {
    const World<D> world = make_world<D>(i);
    SCOPED_TRACE(world.name);
    const Oracle<D> oracle(world.soup);
    const Snapshot<D> snapshot = Snapshot<D>::compile(world.soup, glue(world.soup));
    const Locator<D> locator(snapshot);
    Motion_source<D> source(world, i);
    for (std::size_t k = 0; k < points_per_world && !::testing::Test::HasFatalFailure(); ++k)
      compare(oracle, snapshot, locator, source.start(source.kind(k % 4 == 0)), tally);
  }
  std::cout << tally.points << " points: outside " << tally.outside << ", solid " << tally.solid
            << ", sides 1 " << tally.one_side << ", 2 " << tally.two_sides << ", more " << tally.more_sides
            << "; by dimension";
  for (std::size_t n : tally.by_dimension) std::cout << ' ' << n;
  std::cout << "; most cells " << tally.most_cells << '\n';
  const std::size_t percent = tally.points / 100;
  EXPECT_GE(tally.points, points);
  EXPECT_GT(tally.outside, percent);
  EXPECT_GT(tally.solid, percent / 2);
  EXPECT_GT(tally.one_side, 20 * percent);
  EXPECT_GT(tally.two_sides, 2 * percent);
  EXPECT_GT(tally.more_sides, percent / 10);
  for (int d = 0; d <= D; ++d) EXPECT_GT(tally.by_dimension[d], 2 * percent);
  return tally;
}

TEST(LocateOracle, AgreesInThePlane) { EXPECT_GE(run<2>(6'000'000).most_cells, 6u); }
TEST(LocateOracle, AgreesInSpace) { EXPECT_GE(run<3>(7'000'000).most_cells, 12u); }

}  // namespace
}  // namespace cellwalk::oracle
