// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells by parts of space.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/generators/grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace cellwalk {
namespace {

/// Unit squares, 4 in a row and 3 high. Cell x + 4 y is [x,x+1] x [y,y+1].
Environment<2> unit_squares() {
  Grid_options<2> options;
  options.cells = {4, 3};
  return Environment<2>::build(square_grid(options));
}

Environment_part<2> in_ball(const Point<2>& centre, double radius) {
  Environment_part<2> part;
  part.shape = Scene_ball<2>{centre, radius};
  return part;
}

std::vector<std::uint32_t> indices(const Snapshot<2>& snapshot, const std::vector<Cell>& cells) {
  std::vector<std::uint32_t> result;
  for (const Cell c : cells) result.push_back(snapshot.index(c));
  return result;
}

TEST(Select, CellsByTheirMeansAndFacetsByTheirs) {
  const auto environment = unit_squares();
  const Snapshot<2>& snapshot = environment.snapshot();
  Environment_part<2> part;
  part.shape = Scene_box<2>{{0, 0}, {2, 1}};
  const Selection<2> selection = select(snapshot, part);
  EXPECT_EQ(indices(snapshot, selection.cells), (std::vector<std::uint32_t>{0, 1}));
  // Between cells 0 and 1, above each of them (their means lie on the side of the box), and at x = 2; those
  // of the boundary are none.
  EXPECT_EQ(selection.facets.size(), 4u);
  EXPECT_EQ(indices(snapshot, select(snapshot, in_ball({2.5, 1.5}, 0.4)).cells),
            std::vector<std::uint32_t>{6});
  EXPECT_EQ(select(snapshot, in_ball({2.5, 1.5}, 0.5)).facets.size(), 4u);
  EXPECT_TRUE(select(snapshot, in_ball({9, 9}, 1)).cells.empty());
}

TEST(Select, FacetsBetweenTheSidesOfAPlane) {
  const auto environment = unit_squares();
  const Snapshot<2>& snapshot = environment.snapshot();
  Environment_part<2> part;
  part.plane = Scene_plane<2>{{1.9, 0}, {2, 0}};
  const Selection<2> all = select(snapshot, part);
  EXPECT_EQ(all.facets.size(), 3u);
  for (const Half_facet f : all.facets)
    for (const std::uint32_t v : snapshot.loop(f)) EXPECT_EQ(snapshot.point(v)[0], 2);
  EXPECT_EQ(all.cells.size(), 6u) << "those in front of it";
  part.shape = Scene_ball<2>{{2, 0.5}, 0.25};
  EXPECT_EQ(select(snapshot, part).facets.size(), 1u);
  part.plane->normal = {-2, 0};
  EXPECT_EQ(select(snapshot, part).facets.size(), 1u) << "whichever side is its front";
}

TEST(Select, MeansOfCellsAndFacets) {
  const auto plane = unit_squares();
  const Snapshot<2>& snapshot = plane.snapshot();
  EXPECT_EQ(centroid(snapshot, snapshot.cell(5)), (Point<2>{1.5, 1.5}));
  std::vector<Point<2>> means;
  for (std::size_t f = 0; f < 4; ++f)
    means.push_back(centroid(snapshot, Snapshot<2>::half_facet(snapshot.cell(5), f)));
  std::sort(means.begin(), means.end());
  EXPECT_EQ(means, (std::vector<Point<2>>{{1, 1.5}, {1.5, 1}, {1.5, 2}, {2, 1.5}}));

  const auto space = Environment<3>::build(hex_grid({.cells = {2, 1, 1}}));
  EXPECT_EQ(centroid(space.snapshot(), space.snapshot().cell(1)), (Point<3>{1.5, 0.5, 0.5}));
  Environment_part<3> part;
  part.shape = Scene_box<3>{{1, 0, 0}, {1, 1, 1}};
  const Selection<3> between = select(space.snapshot(), part);
  ASSERT_EQ(between.facets.size(), 1u);
  EXPECT_TRUE(between.cells.empty());
  EXPECT_EQ(centroid(space.snapshot(), between.facets[0]), (Point<3>{1, 0.5, 0.5}));
}

}  // namespace
}  // namespace cellwalk
