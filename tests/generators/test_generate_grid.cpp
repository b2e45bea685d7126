// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

/// How many vertices belong to two solid cells.
template <int D>
std::size_t vertices_of_two_solid_cells(const Cell_soup<D>& soup) {
  std::vector<int> uses(soup.points.size());
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    if (soup.solid[c])
      for (std::uint32_t v : test::vertices_of(soup, c)) ++uses[v];
  std::size_t shared = 0;
  for (int n : uses) shared += n > 1;
  return shared;
}

template <int D>
std::size_t solid_count(const Cell_soup<D>& soup) {
  std::size_t n = 0;
  for (auto s : soup.solid) n += s;
  return n;
}

TEST(HexGrid, HasTheCountsOfAGrid) {
  Grid_options<3> options;
  options.cells = {4, 3, 2};
  const auto soup = hex_grid(options);
  test::expect_sound(soup);
  EXPECT_EQ(soup.cell_count(), 24u);
  EXPECT_EQ(soup.points.size(), 60u);
  EXPECT_EQ(test::count_facets(soup).inner, 3u * 3 * 2 + 4 * 2 * 2 + 4 * 3 * 1);
  EXPECT_EQ(test::volume(soup), 24);
  // Cell (3,2,1) is the last one.
  EXPECT_EQ(*test::vertices_of(soup, 23).begin(), 3u + 5 * (2 + 4 * 1));
}

TEST(HexGrid, SolidCellsTouchNowhere) {
  for (double share : {0.01, 0.05, 0.1, 0.12, 0.125}) {
    Grid_options<3> options;
    options.cells = {20, 22, 16};
    options.solid_share = share;
    const auto soup = hex_grid(options);
    EXPECT_EQ(solid_count(soup), std::size_t(share * 7040 + 0.5)) << share;
    EXPECT_EQ(vertices_of_two_solid_cells(soup), 0u) << share;
    for (std::size_t c = 0; c < soup.cell_count(); ++c)
      for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
        ASSERT_EQ(soup.impassable[f], soup.solid[c]);
  }
  Grid_options<2> plane;
  plane.cells = {41, 30};
  for (double share : {0.1, 0.2, 0.25}) {
    plane.solid_share = share;
    const auto soup = square_grid(plane);
    EXPECT_EQ(solid_count(soup), std::size_t(share * 1230 + 0.5)) << share;
    EXPECT_EQ(vertices_of_two_solid_cells(soup), 0u) << share;
  }
}

TEST(HexGrid, SolidCellsLieEverywhere) {
  // Even at a share where they are spread over layers and rows, they are not bound to every other place.
  Grid_options<3> options;
  options.cells = {30, 30, 30};
  options.solid_share = 0.1;
  const auto soup = hex_grid(options);
  std::array<std::array<int, 2>, 3> odd{};
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    if (soup.solid[c]) ++odd[0][c % 2], ++odd[1][c / 30 % 2], ++odd[2][c / 900 % 2];
  for (const auto& axis : odd) EXPECT_GT(std::min(axis[0], axis[1]), 2700 / 20);
}

TEST(HexGrid, SaysTheLargestShareThatCanBeReached) {
  Grid_options<3> options;
  options.solid_share = 0.2;
  try {
    hex_grid(options);
    FAIL() << "a share of 0.2 cannot lie apart";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Error_code::usage);
    EXPECT_STREQ(e.what(),
                 "grid: 200 solid cells cannot lie apart; at most 125 of 1000 can (share 0.125000)");
  }
}

TEST(HexGrid, TakesAListOfSolidCells) {
  Grid_options<3> options;
  options.solid_cells = {0, 1, 999};
  const auto soup = hex_grid(options);
  EXPECT_EQ(solid_count(soup), 3u);
  EXPECT_TRUE(soup.solid[0] && soup.solid[1] && soup.solid[999]);
  options.solid_share = 0.1;
  EXPECT_THROW(hex_grid(options), Error);
  options.solid_share = 0;
  options.solid_cells = {1000};
  EXPECT_THROW(hex_grid(options), Error);
}

TEST(HexGrid, RefusesSizesItCannotCount) {
  Grid_options<3> options;
  options.cells = {0, 1, 1};
  EXPECT_THROW(hex_grid(options), Error);
  options.cells = {3000, 3000, 3000};
  EXPECT_THROW(hex_grid(options), Error);
}

TEST(HexGrid, StaysPlanarWhenShearedOrRotated) {
  for (const auto& map : {sheared<3>(), rotated<3>(), scaled<3>(0.1), scaled<3>(1e-6)}) {
    Grid_options<3> options;
    options.cells = {3, 4, 5};
    options.map = map;
    test::expect_sound(hex_grid(options));
  }
  Grid_options<3> options;
  options.map = sheared<3>(0.1);  // rounds
  EXPECT_THROW(hex_grid(options), Error);
}

TEST(SquareGrid, IsSound) {
  Grid_options<2> options;
  options.cells = {6, 5};
  options.map = rotated<2>();
  const auto soup = square_grid(options);
  test::expect_sound(soup);
  EXPECT_EQ(test::volume(soup), 30 * 25);
  EXPECT_EQ(test::count_facets(soup).inner, 5u * 5 + 6 * 4);
}

TEST(SimplexGrid, TetrahedraConformAndArePositive) {
  for (double jitter : {0.0, 0.15}) {
    Simplex_grid_options<3> options;
    options.cells = {5, 4, 3};
    options.jitter = jitter;
    const auto soup = tetrahedral_grid(options);
    test::expect_sound(soup);
    EXPECT_EQ(soup.cell_count(), 360u);
    EXPECT_EQ(test::count_facets(soup).boundary, 4u * (20 + 15 + 12));
  }
  Simplex_grid_options<3> options;
  options.jitter = 0.2;
  EXPECT_THROW(tetrahedral_grid(options), Error);
}

TEST(SimplexGrid, TrianglesConformAndArePositive) {
  Simplex_grid_options<2> options;
  options.jitter = 0.15;
  options.map = scaled<2>(0.1);
  const auto soup = triangle_grid(options);
  test::expect_sound(soup);
  EXPECT_EQ(soup.cell_count(), 200u);
  EXPECT_EQ(test::count_facets(soup).boundary, 40u);
}

TEST(Grids, AreReproducible) {
  Grid_options<3> grid;
  grid.solid_share = 0.05;
  EXPECT_EQ(test::hash(hex_grid(grid)), 2608476443287624506u);
  grid.solid_share = 0.1;
  EXPECT_EQ(test::hash(hex_grid(grid)), 2693365543629956202u);
  Simplex_grid_options<3> simplices;
  simplices.jitter = 0.1;
  EXPECT_EQ(test::hash(tetrahedral_grid(simplices)), 2796835957439332498u);
}

}  // namespace
}  // namespace cellwalk
