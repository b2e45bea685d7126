// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells around points, found in the snapshot, against a search of all cells.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "environment/snapshot_checks.h"

namespace cellwalk {
namespace {

template <int D>
void expect_all_stars(Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  std::vector<std::vector<Cell>> stars(snapshot.points().size());
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none)
      for (const std::uint32_t p : snapshot.view(c).vertices) stars[p].push_back(c);
  for (std::uint32_t p = 0; p < stars.size(); ++p) {
    std::vector<Cell> found = environment.cells_around(p);
    EXPECT_EQ(environment.cells_around(p), found) << "kept for the next time";
    std::sort(found.begin(), found.end());
    std::sort(stars[p].begin(), stars[p].end());
    ASSERT_EQ(found, stars[p]) << "point " << p;
  }
}

template <int D>
void compare(std::size_t& pinched) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    auto options = mixed_lattice_world<D>(seed);
    options.cells.fill(D == 2 ? 6 : 3);
    options.removed_share = 0.3;  // many pinched vertices
    Build_report report;
    Environment<D> environment =
        Environment<D>::build(lattice_world(options), {.keep_map = seed % 3 != 0}, &report);
    pinched += report.certificate.pinched_vertices;
    expect_all_stars(environment);
    if (environment.is_frozen()) continue;
    Random random(seed);
    for (int i = 0; i < 12; ++i) {
      const Cell c = environment.snapshot().cell(random.below(environment.snapshot().cell_count()));
      environment.insert_point(c, test::mean_of_vertices(environment.snapshot().view(c)));
      if (i % 4 == 0) expect_all_stars(environment);
    }
    expect_all_stars(environment);
  }
}

TEST(StarIndex, FindsAllCellsAroundAPoint2) {
  std::size_t pinched = 0;
  compare<2>(pinched);
  EXPECT_GT(pinched, 10u);
}

TEST(StarIndex, FindsAllCellsAroundAPoint3) {
  std::size_t pinched = 0;
  compare<3>(pinched);
  EXPECT_GT(pinched, 10u);
}

TEST(StarIndex, RefusesPointsThatAreNotThere) {
  Environment<2> environment = Environment<2>::build(lattice_world(mixed_lattice_world<2>(1)));
  const auto points = static_cast<std::uint32_t>(environment.snapshot().points().size());
  EXPECT_THROW(environment.cells_around(points), Error);
}

}  // namespace
}  // namespace cellwalk
