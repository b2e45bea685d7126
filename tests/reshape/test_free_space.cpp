// SPDX-License-Identifier: LGPL-3.0-or-later
// A cut takes nothing from free space, not by a unit in the last place: membranes that are fixed in tissue
// are slit, and edges of walls split at rounded points, while a judge in rational numbers looks at all cells.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "oracle/seed.h"
#include "reshape/cut_judge.h"
#include "reshape/tissue_block.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

/// The edges of membranes that solid cells have, too.
template <int D>
std::set<std::array<std::uint32_t, 2>> fixed_edges(Environment<D>& environment) {
  const Snapshot<D>& s = environment.snapshot();
  std::set<std::array<std::uint32_t, 2>> of_membranes, of_solid, both;
  for (std::size_t i = 0; i < s.cell_slots(); ++i) {
    const Cell c = s.cell(i);
    if (c == Cell::none) continue;
    for (std::size_t k = 0; k <= D; ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const Cell other = s.neighbour(f);
      const bool is_membrane =
          other != Cell::none && s.is_impassable(f) && !s.is_solid(c) && !s.is_solid(other);
      if (!is_membrane && !s.is_solid(c)) continue;
      const auto loop = s.loop(f);
      for (const std::uint32_t u : loop)
        for (const std::uint32_t v : loop)
          if (u < v) (is_membrane ? of_membranes : of_solid).insert({u, v});
    }
  }
  std::ranges::set_intersection(of_membranes, of_solid, std::inserter(both, both.begin()));
  return both;
}

template <int D>
void cut_worlds(std::size_t worlds) {
  std::size_t fixed = 0, split = 0, slit = 0, opened = 0, refused = 0;
  const std::size_t count = std::max(oracle::scaled_count(worlds), worlds / 2);
  for (std::uint64_t number = 0; number < count; ++number) {
    SCOPED_TRACE("world " + std::to_string(number));
    Random random(oracle::reseeded(number));
    constexpr std::uint32_t size = D == 2 ? 6 : 3;
    auto environment = test::tissue<D>(size, random.real(0.3, 0.8) * size, 0.15, number);
    const Snapshot<D>& s = environment.snapshot();
    for (std::size_t i = 0; i < s.cell_slots(); ++i)
      for (std::size_t k = 0; k <= D; ++k)
        if (random.chance(0.15)) environment.set_impassable(Snapshot<D>::half_facet(s.cell(i), k), true);
    std::vector<Point<D>> blade(D);
    for (Point<D>& x : blade)
      for (double& c : x) c = random.real(-0.5, size + 0.5);
    const auto held = fixed_edges(environment);
    const test::Cut_judge<D> judge(s);
    Reshaping<D> reshaping(environment, {});
    const Cut_report report = reshaping.cut(
        blade_along<D>(blade), {.opening = std::ldexp(0.25, -static_cast<int>(random.below(8)))});
    reshaping.finish();
    ASSERT_NO_THROW(environment.certify());
    for (const Cut_point& point : report.points) fixed += held.contains(point.between);
    split += report.split;
    slit += report.slit;
    opened += report.opened;
    refused += report.refused();
    const test::Cut_findings found = judge.changes();
    EXPECT_TRUE(found.has_same_volume);
    EXPECT_EQ(found.flat, 0u);
    ASSERT_EQ(found.entered, 0u) << "solid where there was free space";
    EXPECT_EQ(found.unmarked, 0u);
  }
  std::printf(
      "%dD: %zu cuts, %zu edges split, of these %zu of membranes in tissue, %zu refused; %zu facets slit, "
      "%zu vertices parted\n",
      D, count, split, fixed, refused, slit, opened);
  // These are counts of what the worlds of a seed happen to have. But in the plane an edge is a facet, and
  // none is one of a membrane and of a solid cell.
  if (D == 2) {
    EXPECT_EQ(fixed, 0u);
  } else {
    EXPECT_GT(fixed, count / 20);
  }
  EXPECT_GT(slit, count / 4);
  EXPECT_GT(opened, D == 2 ? count : count / 2);  // in space, cuts that small part few vertices
}

TEST(FreeSpace, IsNotTakenByCuts2D) { cut_worlds<2>(150); }
TEST(FreeSpace, IsNotTakenByCuts3D) { cut_worlds<3>(40); }

}  // namespace
}  // namespace cellwalk
