// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include "common/order_statistics.h"
#include "common/peers/float_box.h"
#include "common/peers/growing_box.h"
#include "common/peers/wall_mesh.h"
#include "common/peers/wall_triangle.h"

namespace cellwalk::experiments {
namespace {

Cell_soup<3> grid_with_solid_cells() {
  Grid_options<3> options;
  options.cells = {3, 3, 3};
  options.solid_cells = {13, 14};  // the one in the middle, and one at the boundary
  return hex_grid(options);
}

TEST(WallMesh, CoversEveryWallOnce) {
  const Cell_soup<3> soup = grid_with_solid_cells();
  const Wall_mesh walls = wall_mesh(soup, glue(soup));
  // 54 squares around the grid, and 12 sides of the solid cells, of which one is among the 54; what parts
  // the two cells is a wall as well.
  EXPECT_EQ(walls.triangles.size(), 2u * (54 + 10));
}

TEST(WallMesh, FacesTheWall) {
  const Cell_soup<3> soup = grid_with_solid_cells();
  const Wall_mesh walls = wall_mesh(soup, glue(soup), Facing::wall);
  // The free space alone has walls: 53 squares around the grid, and 9 sides of the solid cells.
  EXPECT_EQ(walls.triangles.size(), 2u * (53 + 9));
  EXPECT_EQ(enclosed_volume(walls), 25);
}

TEST(WallMesh, HasBothSidesOfAMembrane) {
  Cell_soup<3> soup = hex_grid(Grid_options<3>{.cells = {2, 1, 1}});
  const Gluing gluing = glue(soup);
  std::uint32_t inner = 0;
  while (gluing.opposite[inner] == no_facet) ++inner;
  soup.impassable[inner] = 1;
  EXPECT_EQ(wall_mesh(soup, gluing).triangles.size(), 2u * 11);
  EXPECT_EQ(wall_mesh(soup, gluing, Facing::wall).triangles.size(), 2u * 12);
}

TEST(WallTriangle, TellsSidesAndLines) {
  const Wall_triangle<float> wall({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  const auto at = [](double x, double y, double z) { return rounded<float>({x, y, z}); };
  EXPECT_GT(wall.side(at(0, 0, 2)), 0);
  EXPECT_LT(wall.side(at(0, 0, 0)), 0);
  EXPECT_EQ(wall.side(at(7, 3, 1)), 0);
  EXPECT_TRUE(wall.is_on_line(at(0.2, 0.2, 0), at(0.2, 0.2, 2)));
  EXPECT_FALSE(wall.is_on_line(at(0.6, 0.6, 0), at(0.6, 0.6, 2)));
}

TEST(Boxes, GrowAndMeetAlike) {
  Random random(1);
  const auto point = [&] { return Point<3>{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)}; };
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point<3> a = point(), b = point(), c = point(), d = point();
    Growing_box growing(a);
    growing.add(b);
    const Box first = growing.box(), second = box_of(c, d);
    EXPECT_EQ(first.low, box_of(a, b).low);
    EXPECT_EQ(first.high, box_of(a, b).high);
    if (!meet(first, second)) continue;
    ++met;
    EXPECT_TRUE(meet(Float_box(first), Float_box(second)));
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(met, 1900);
}

TEST(Boxes, RoundedOutwardButNotFar) {
  const Point<3> p{0.1, -0.1, 1e-60}, q{0.1 + 1e-12, -0.1 + 1e-12, 1e-50}, far{0.1001, 0, 0};
  EXPECT_TRUE(meet(Float_box(box_of(p, p)), Float_box(box_of(q, q))));
  EXPECT_FALSE(meet(Float_box(box_of(p, p)), Float_box(box_of(far, far))));
  EXPECT_FALSE(Box::nowhere().contains(box_of(p, p)));
  EXPECT_TRUE(box_of(p, p).enlarged(1e-3).contains(box_of(q, q)));
}

TEST(OrderStatistics, MediansAndQuantiles) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(quantile({4, 1, 2, 3}, 0.5), 2);
  EXPECT_EQ(quantile({4, 1, 2, 3}, 0.51), 3);
  EXPECT_EQ(quantile({4, 1, 2, 3}, 1), 4);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

}  // namespace
}  // namespace cellwalk::experiments
