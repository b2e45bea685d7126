// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "environment/cell_samples.h"
#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

using test::cube;
using test::polygon;
using test::prism;
using test::Sample_cell;
using test::tetrahedron;

template <int D>
void expect(const Sample_cell<D>& cell, Cell_defect defect, std::size_t facet = 0) {
  const Cell_check check = cell.check();
  EXPECT_EQ(check.defect, defect) << describe(check);
  EXPECT_EQ(check.facet, facet) << describe(check);
}

const std::vector<Point<2>> ell{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
const std::vector<Point<2>> square_with_middles{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
/// Five corners walked in the order 0 2 4 1 3: every turn is to the left, twice round.
const std::vector<Point<2>> pentagram{{4, 0}, {-3, 2}, {1, -4}, {1, 4}, {-3, -2}};

TEST(CheckCell, AcceptsConvexCells) {
  expect(tetrahedron(), Cell_defect::none);
  expect(cube(), Cell_defect::none);
  expect(prism({{0, 0}, {3, 0}, {4, 2}, {1, 3}}), Cell_defect::none);
}

TEST(CheckCell, AcceptsVerticesInsideStraightSides) {
  expect(prism(square_with_middles), Cell_defect::none);
  expect(polygon(square_with_middles), Cell_defect::none);
}

TEST(CheckCell, AcceptsSeveralCoplanarFacets) {
  Sample_cell<3> cell = cube();
  cell.loops.erase(cell.loops.begin());
  cell.loops.insert(cell.loops.end(), {{0, 3, 2}, {0, 2, 1}});
  expect(cell, Cell_defect::none);
  // Every facet has a coplanar one: only the test for overlaps is left to tell this from a wound surface.
  Sample_cell<3> all_cut{cube().points, {}};
  for (const auto& loop : cube().loops) {
    all_cut.loops.push_back({loop[0], loop[1], loop[2]});
    all_cut.loops.push_back({loop[0], loop[2], loop[3]});
  }
  expect(all_cut, Cell_defect::none);
}

TEST(CheckCell, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Sample_cell<3> cell = tetrahedron();
    cell.points[2][1] = bad;
    expect(cell, Cell_defect::not_finite);
    Sample_cell<2> triangle = polygon({{0, 0}, {1, 0}, {0, bad}});
    expect(triangle, Cell_defect::not_finite);
  }
}

TEST(CheckCell, RefusesSurfacesThatAreNotClosed) {
  Sample_cell<3> open = cube();
  open.loops.pop_back();
  expect(open, Cell_defect::not_closed, 0);
  Sample_cell<3> turned = cube();
  std::reverse(turned.loops[4].begin(), turned.loops[4].end());
  EXPECT_EQ(turned.check().defect, Cell_defect::not_closed);
  Sample_cell<3> unused_vertex = cube();
  unused_vertex.points.push_back({1, 1, 1});
  expect(unused_vertex, Cell_defect::not_closed);
}

TEST(CheckCell, RefusesTwoSurfacesInOneCell) {
  Sample_cell<3> apart = tetrahedron(), touching = tetrahedron();
  for (const Point<3>& p : tetrahedron().points) apart.points.push_back(p + Point<3>{5, 0, 0});
  for (auto loop : tetrahedron().loops) {
    for (auto& v : loop) v = static_cast<std::uint16_t>(v + 4);
    apart.loops.push_back(loop);
  }
  expect(apart, Cell_defect::not_closed);
  // Two tetrahedra that share vertex 0.
  touching.points.insert(touching.points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  touching.loops.insert(touching.loops.end(), {{0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {5, 6, 0}});
  expect(touching, Cell_defect::not_closed);
}

TEST(CheckCell, RefusesATorusAndASurfacePinchedAtAVertex) {
  // Three boxes in a ring: every edge has two facets, but the characteristic is 0.
  Sample_cell<3> torus;
  const std::array<Point<2>, 3> inner{{{1, 0}, {-1, 1}, {-1, -1}}};
  for (const Point<2>& p : inner)
    for (const double scale : {1.0, 2.0})
      for (const double z : {0.0, 1.0}) torus.points.push_back({scale * p[0], scale * p[1], z});
  for (std::uint16_t i = 0; i < 3; ++i) {
    const auto v = [&](int side, int corner) {
      return static_cast<std::uint16_t>((i + side) % 3 * 4 + corner);
    };
    torus.loops.push_back({v(0, 0), v(0, 1), v(1, 1), v(1, 0)});
    torus.loops.push_back({v(0, 1), v(0, 3), v(1, 3), v(1, 1)});
    torus.loops.push_back({v(0, 3), v(0, 2), v(1, 2), v(1, 3)});
    torus.loops.push_back({v(0, 2), v(0, 0), v(1, 0), v(1, 2)});
  }
  expect(torus, Cell_defect::not_closed);
}

TEST(CheckCell, RefusesDegenerateFacets) {
  Sample_cell<3> needle = tetrahedron();
  needle.points[3] = {2, 0, 0};
  expect(needle, Cell_defect::degenerate_facet, 1);
  // A cube with a flat triangle between an edge and a vertex on it.
  Sample_cell<3> cell = cube();
  cell.points.push_back({1, 0, 0});
  cell.loops[2] = {0, 8, 1, 5, 4};
  cell.loops.push_back({0, 1, 8});
  expect(cell, Cell_defect::degenerate_facet, 6);
  expect(prism({{0, 0}, {2, 0}, {2, 0}, {0, 2}}), Cell_defect::degenerate_facet, 3);
  Sample_cell<3> two_gon = tetrahedron();
  two_gon.loops.push_back({0, 1});
  expect(two_gon, Cell_defect::degenerate_facet, 4);
  expect(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), Cell_defect::degenerate_facet, 1);
}

TEST(CheckCell, RefusesFacetsOffTheirPlaneByOneUlp) {
  Sample_cell<3> cell = prism({{0, 0}, {3, 1}, {4, 2}, {1, 3}});
  expect(cell, Cell_defect::none);
  cell.points[6][2] = std::nextafter(cell.points[6][2], 2.0);
  expect(cell, Cell_defect::facet_not_planar, 1);
}

TEST(CheckCell, RefusesFacetsThatAreNotConvex) {
  expect(prism(ell), Cell_defect::facet_not_convex, 0);
  expect(prism(pentagram), Cell_defect::facet_not_convex, 0);
  expect(prism({{0, 0}, {3, 0}, {1, 0}, {0, 2}}), Cell_defect::facet_not_convex, 0);
  Sample_cell<3> twice = cube();
  twice.loops[0] = {0, 3, 2, 1, 2};
  expect(twice, Cell_defect::facet_not_convex, 0);
}

TEST(CheckCell, RefusesCellsThatAreNotConvex) {
  // A pyramid pushed into the top of a cube.
  Sample_cell<3> dented = cube();
  dented.points.push_back({1, 1, 1});
  dented.loops.erase(dented.loops.begin() + 1);
  dented.loops.insert(dented.loops.end(), {{4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}});
  expect(dented, Cell_defect::not_convex, 5);
  expect(polygon(ell), Cell_defect::not_convex, 2);
  expect(polygon({{0, 0}, {3, 0}, {1, 0}, {0, 2}}), Cell_defect::not_convex, 1);
}

TEST(CheckCell, RefusesInvertedCells) {
  expect(tetrahedron().reversed(), Cell_defect::inverted);
  expect(cube().reversed(), Cell_defect::inverted);
  expect(polygon({{0, 0}, {0, 1}, {1, 0}}), Cell_defect::inverted);
}

TEST(CheckCell, RefusesFlatCells) {
  Sample_cell<3> flat = tetrahedron();
  flat.points[3] = {1, 1, 0};
  expect(flat, Cell_defect::flat);
  expect(Sample_cell<3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, Cell_defect::flat);
  expect(polygon({{0, 0}, {2, 2}, {1, 1}}), Cell_defect::flat);
}

TEST(CheckCell, RefusesSurfacesThatWindTwice) {
  expect(test::wound_octahedron(), Cell_defect::wound, 0);
  expect(polygon(pentagram), Cell_defect::wound);
}

TEST(CheckCell, DecidesExactlyAtExtremeScales) {
  for (const double scale : {0x1p-200, 0x1p+200}) {
    Sample_cell<3> cell = prism(square_with_middles);
    for (Point<3>& p : cell.points) p = scale * p;
    expect(cell, Cell_defect::none);
    cell.points[1][1] =
        -scale * 0x1p-60;  // the middle of the bottom's first side, outwards by next to nothing
    expect(cell, Cell_defect::facet_not_planar, 2);
  }
}

TEST(CheckCell, AgreesWithBruteForceOnLatticeHexahedra) {
  Random random(7);
  int sound = 0, unsound = 0;
  for (int i = 0; i < 20000; ++i) {
    Sample_cell<3> cell = cube();
    for (Point<3>& p : cell.points)
      for (double& x : p)
        if (random.below(8) == 0) x += static_cast<double>(random.below(3)) - 1;
    const bool is_sound = test::flaw(cell.soup(), 0).empty();
    const Cell_check check = cell.check();
    ASSERT_EQ(check.defect == Cell_defect::none, is_sound) << describe(check) << " in round " << i;
    ++(is_sound ? sound : unsound);
  }
  EXPECT_GT(sound, 500);
  EXPECT_GT(unsound, 5000);
}

TEST(CheckCell, AgreesWithBruteForceOnLatticePolygons) {
  Random random(8);
  int sound = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Point<2>> points(3 + random.below(3));
    for (Point<2>& p : points)
      p = {static_cast<double>(random.below(4)), static_cast<double>(random.below(4))};
    const Sample_cell<2> cell = polygon(points);
    // Convex, and no two vertices equal: with all vertices left of each side it turns once.
    std::vector<Point<2>> sorted = points;
    std::sort(sorted.begin(), sorted.end());
    const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    bool spikes = false;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point<2>&a = points[k], &b = points[(k + 1) % points.size()],
            &c = points[(k + 2) % points.size()];
      spikes |= (b[0] - a[0]) * (c[1] - b[1]) == (b[1] - a[1]) * (c[0] - b[0]) && dot(b - a, c - b) < 0;
    }
    const bool is_sound = test::flaw(cell.soup(), 0).empty() && !repeats && !spikes;
    ASSERT_EQ(cell.check().defect == Cell_defect::none, is_sound)
        << describe(cell.check()) << " in round " << i;
    sound += is_sound;
  }
  EXPECT_GT(sound, 500);
}

TEST(CheckCell, DescribesEveryDefect) {
  EXPECT_EQ(describe({Cell_defect::facet_not_planar, 3}), "facet 3 is not exactly planar");
  for (int d = 0; d <= static_cast<int>(Cell_defect::wound); ++d) {
    const std::string line = describe({static_cast<Cell_defect>(d), 1});
    EXPECT_FALSE(line.empty());
    EXPECT_NE(line, "unknown defect");
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace cellwalk
