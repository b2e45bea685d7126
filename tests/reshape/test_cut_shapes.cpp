// SPDX-License-Identifier: LGPL-3.0-or-later
// Blades of many shapes, and tissue of many: cuts stay sound in all of them.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "reshape/tissue_block.h"
#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"

namespace cellwalk {
namespace {

/// Squares, of which only some are divided into triangles.
Cell_soup<2> squares_and_triangles(std::uint32_t size, std::uint64_t seed) {
  Cell_soup<2> soup;
  Random random(seed);
  const auto point = [&](std::uint32_t i, std::uint32_t j) { return j * (size + 1) + i; };
  for (std::uint32_t j = 0; j <= size; ++j)
    for (std::uint32_t i = 0; i <= size; ++i)
      soup.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  const auto add = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) soup.add_facet({loop[k], loop[(k + 1) % loop.size()]});
    soup.end_cell();
  };
  for (std::uint32_t j = 0; j < size; ++j)
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      if (random.chance(0.3)) {
        add({a, b, c, d});
      } else {
        add({a, b, c});
        add({a, c, d});
      }
    }
  test::fill_below(soup, 0.8 * size);
  return soup;
}

/// Cuts, and expects that all is certified, and that free space grew.
template <int D>
Cut_report sound_cut(Environment<D>& environment, const Blade<D>& by, double opening) {
  const Certificate before = environment.certify();
  Reshaping<D> reshaping(environment, {});
  const Cut_report report = reshaping.cut(by, {.opening = opening});
  reshaping.close();
  Certificate after;
  EXPECT_NO_THROW(after = environment.certify());
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
  EXPECT_GE(after.free_volume, before.free_volume * (1 - 1e-12));
  EXPECT_EQ(after.vertices, before.vertices + report.points.size());
  return report;
}

/// Cells of other shapes hold together, with what they touch.
TEST(CutShapes, LeaveSquaresWhole) {
  std::size_t held = 0, opened = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const double lean : {0.0, 0.1, 0.5, 4.0}) {
      auto environment = Environment<2>::build(squares_and_triangles(7, seed));
      const auto squares = [&] {
        std::size_t count = 0;
        for (std::size_t i = 0; i < environment.snapshot().cell_slots(); ++i)
          if (const Cell c = environment.snapshot().cell(i); c != Cell::none)
            count += environment.snapshot().facet_count(c) == 4;
        return count;
      };
      const std::size_t before = squares();
      // Along the diagonals of squares, or steeper.
      const double down = lean == 4 ? 4 : 3.5;
      const Cut_report report =
          sound_cut<2>(environment, test::blade<2>({{3 + lean, 3 + down}, {3 - lean, 3 - down}}), 0.05);
      EXPECT_EQ(squares(), before) << seed;
      held += report.held;
      opened += report.opened;
      refused += report.refused();
    }
  EXPECT_GT(held, 8u);
  EXPECT_GT(opened, 50u);
  EXPECT_GT(refused, 15u);
}

/// Boxes, prisms, stars and simplices on lattices, some of them solid: whatever is cut, all stays certified.
template <int D>
void cut_lattices(std::size_t worlds) {
  std::size_t edges = 0, opened = 0, whole = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    oracle::World<D> world = oracle::make_world<D>(number);
    SCOPED_TRACE(world.name + " " + std::to_string(number));
    Random random(number);
    for (auto& solid : world.soup.solid) solid = solid || random.chance(0.7);
    Point<D> low = world.soup.points[0], high = low;
    for (const Point<D>& x : world.soup.points)
      for (std::size_t k = 0; k < D; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
    auto environment = Environment<D>::build(world.soup, {.duplicates = Duplicate_vertices::keep});
    for (int turn = 0; turn < 2; ++turn) {
      std::vector<Point<D>> points(turn == 0 ? D : 2 * D - 2);
      const auto axis = static_cast<std::size_t>(random.below(D));
      const double level = random.real(0.2, 0.8);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < D; ++k) {
          double share = random.real(-0.2, 1.2);
          if (turn == 1) {  // across all
            const std::size_t corner = D == 2 ? i : (k == (axis + 1) % 3) ? i / 2 : (i + 1) / 2 % 2;
            share = k == axis ? level : corner == 0 ? -0.3 : 1.3;
          }
          if (random.chance(turn == 1 ? (number % 2 == 0) : 0.5)) share = std::round(8 * share) / 8;
          points[i][k] = low[k] + share * (high[k] - low[k]);
        }
      try {
        const Cut_report report =
            sound_cut<D>(environment, blade_along<D>(points), 0.02 * (high[0] - low[0]));
        edges += report.edges;
        opened += report.opened;
        whole += report.refused() + report.held;
      } catch (const Error& e) {
        ASSERT_EQ(e.code(), Error_code::input) << e.what();  // the points lie in line
      }
      if (testing::Test::HasFailure()) return;
    }
  }
  std::printf("%dD: %zu edges passed, %zu vertices parted, %zu edges and vertices whole\n", D, edges, opened,
              whole);
  EXPECT_GT(edges, worlds);
  EXPECT_GT(opened, worlds / 4);
  EXPECT_GT(whole, worlds / 4);
}

TEST(CutShapes, OfLatticesInThePlane) {
  cut_lattices<2>(std::max<std::size_t>(oracle::scaled_count(90), 45));
}
TEST(CutShapes, OfLatticesInSpace) { cut_lattices<3>(std::max<std::size_t>(oracle::scaled_count(60), 30)); }

}  // namespace
}  // namespace cellwalk
