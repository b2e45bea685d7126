// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells of random edges, compared with integral geometry (Crofton): lines meet surfaces in proportion to
// their area.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

#include <numbers>

namespace cellwalk {
namespace {

constexpr Build_options plain{.split = false, .keep_map = false};

template <int D>
Edge_cells count(Cell_soup<D> soup, const Edge_cells_options& options) {
  const auto environment = Environment<D>::build(std::move(soup), plain);
  return count_edge_cells(environment.snapshot(), options);
}

/// The mean is that far from walls, or a little less: an edge in a grid of n cells, of length d along an
/// axis, crosses (n-1) d / (n-d) inner planes on average.
void expect_mean(const Edge_cells& found, double facets, double n) {
  EXPECT_LT(found.standard_error, 0.01);
  EXPECT_LT(found.cells, 1 + facets + 4 * found.standard_error);
  EXPECT_GT(found.cells, 1 + facets * (n - 1) / n - 4 * found.standard_error);
}

/// The share of edges that meet a wall, to the first order of their length over the distance of walls.
void expect_share_blocked(const Edge_cells& found, double share) {
  EXPECT_NEAR(static_cast<double>(found.blocked) / static_cast<double>(found.edges + found.blocked), share,
              0.2 * share);
}

TEST(EdgeCells, OfUnitCubesAreThoseOfTheArea) {
  for (const double length : {0.25, 0.5, 1.0}) {
    const Edge_cells found = count(hex_grid({.cells = {20, 20, 20}}), {.length = length, .edges = 20000});
    EXPECT_EQ(found.edges, 20000u);
    EXPECT_EQ(found.length, length);
    EXPECT_DOUBLE_EQ(found.wall_distance, 4 * 8000 / 2400.0);
    EXPECT_GT(found.standard_error, 0);
    expect_mean(found, 3 * length / 2, 20);
    expect_share_blocked(found, length / found.wall_distance);
  }
}

TEST(EdgeCells, OfUnitSquaresAreThoseOfTheLength) {
  const Edge_cells found = count(square_grid({.cells = {50, 50}}), {.length = 0.5, .edges = 20000});
  EXPECT_DOUBLE_EQ(found.wall_distance, std::numbers::pi * 2500 / 200);
  expect_mean(found, 2 * 0.5 * 2 / std::numbers::pi, 50);
  expect_share_blocked(found, 0.5 / found.wall_distance);
}

TEST(EdgeCells, LieInFreeSpaceOnly) {
  const auto soup = hex_grid({.cells = {12, 12, 12}, .solid_share = 0.1, .seed = 3});
  const Edge_cells open = count(hex_grid({.cells = {12, 12, 12}}), {.length = 1});
  const Edge_cells found = count(soup, {.length = 1});
  EXPECT_LT(found.wall_distance, 0.7 * open.wall_distance);
  EXPECT_GT(found.blocked, 2 * open.blocked);
  EXPECT_EQ(found.edges, 4096u);
}

TEST(EdgeCells, GrowAsCellsGetFiner) {
  const Edge_cells_options options{.length = 0.5};
  const Edge_cells cubes = count(hex_grid({.cells = {8, 8, 8}}), options);
  const Edge_cells tetrahedra = count(tetrahedral_grid({.cells = {8, 8, 8}}), options);
  EXPECT_GT(tetrahedra.cells, 1.5 * cubes.cells);
  EXPECT_DOUBLE_EQ(tetrahedra.wall_distance, cubes.wall_distance);
}

TEST(EdgeCells, ByDefaultAreATenthOfTheDistanceOfWallsLong) {
  const Edge_cells found = count(hex_grid({.cells = {10, 10, 10}}), {});
  EXPECT_DOUBLE_EQ(found.length, 0.1 * 4 * 1000 / 600);
  EXPECT_EQ(found.edges, 4096u);
}

TEST(EdgeCells, AreNoneWhereEdgesDoNotFit) {
  const Edge_cells found = count(hex_grid({.cells = {3, 3, 3}}), {.length = 6, .edges = 100});
  EXPECT_EQ(found.edges, 0u);
  EXPECT_EQ(found.blocked, 800u);
  EXPECT_EQ(found.cells, 0);
}

TEST(EdgeCells, AreNoneWithoutFreeSpace) {
  auto soup = hex_grid({.cells = {2, 1, 1}});
  soup.solid.assign(soup.cell_count(), 1);
  soup.impassable.assign(soup.facet_count(), 1);
  const Edge_cells found = count(std::move(soup), {.length = 1});
  EXPECT_EQ(found.wall_distance, 0);
  EXPECT_EQ(found.edges + found.blocked, 0u);
}

TEST(EdgeCells, AreTheSameForTheSameSeed) {
  const auto mean = [](std::uint64_t seed) {
    return count(tetrahedral_grid({.cells = {4, 4, 4}}), {.length = 0.5, .edges = 1000, .seed = seed}).cells;
  };
  EXPECT_EQ(mean(1), mean(1));
  EXPECT_NE(mean(1), mean(2));
}

/// The same cells, with other first vertices of cells and loops.
TEST(EdgeCells, DoNotDependOnTheListing) {
  const auto soup = tetrahedral_grid({.cells = {3, 3, 3}, .jitter = 0.1});
  Cell_soup<3> listed;
  for (std::size_t p = soup.points.size(); p-- > 0;) listed.points.push_back(soup.points[p]);
  const auto renamed = [&soup](std::uint32_t v) {
    return static_cast<std::uint32_t>(soup.points.size() - 1) - v;
  };
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    for (auto f = soup.cell_begin[c + 1]; f-- > soup.cell_begin[c];) {
      const auto loop = soup.facet(f);
      listed.add_facet({renamed(loop[1]), renamed(loop[2]), renamed(loop[0])}, soup.impassable[f]);
    }
    listed.end_cell();
  }
  const Edge_cells found = count(soup, {}), same = count(std::move(listed), {});
  EXPECT_EQ(found.wall_distance, same.wall_distance);
  EXPECT_EQ(found.cells, same.cells);
  EXPECT_EQ(found.blocked, same.blocked);
}

}  // namespace
}  // namespace cellwalk
