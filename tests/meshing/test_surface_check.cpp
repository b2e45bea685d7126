// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include <limits>

#include "meshing/shapes.h"

namespace cellwalk {
namespace {

using test::box;
using test::octahedron;
using test::refusal;

std::string why(const Surface_soup& s) {
  return refusal([&] { check_surface(s); });
}

TEST(SurfaceCheck, AcceptsACleanSurfaceAsItIs) {
  Surface_report report;
  const auto s = check_surface(octahedron(1), "surface", &report);
  EXPECT_EQ(s.points, octahedron(1).points);
  EXPECT_EQ(s.facets.size(), 32u);
  EXPECT_TRUE(describe(report).empty());
  EXPECT_EQ(report.components, 1u);
  EXPECT_DOUBLE_EQ(report.volume, 4.0 / 3);
}

TEST(SurfaceCheck, CutsPolygonsIntoTriangles) {
  Surface_report report;
  EXPECT_EQ(check_surface(box({0, 0, 0}, {1, 2, 3}), "surface", &report).facets.size(), 12u);
  EXPECT_EQ(report.triangulated_facets, 6u);
  EXPECT_DOUBLE_EQ(report.volume, 6);
}

TEST(SurfaceCheck, TurnsASurfaceThatIsInsideOut) {
  Surface_report report;
  const auto s = check_surface(test::turned(octahedron()), "surface", &report);
  EXPECT_TRUE(report.inside_out);
  EXPECT_EQ(report.turned_facets, 0u);
  EXPECT_DOUBLE_EQ(report.volume, 4.0 / 3);
  EXPECT_EQ(describe(report), std::vector<std::string>{"the surface was inside out: all facets turned"});
}

TEST(SurfaceCheck, TurnsFacetsThatDisagree) {
  auto s = octahedron();
  std::reverse(s.facets[3].begin(), s.facets[3].end());
  std::reverse(s.facets[6].begin(), s.facets[6].end());
  Surface_report report;
  check_surface(s, "surface", &report);
  EXPECT_EQ(report.turned_facets, 2u);
  EXPECT_FALSE(report.inside_out);
  EXPECT_DOUBLE_EQ(report.volume, 4.0 / 3);
}

TEST(SurfaceCheck, OrientsNestedComponentsAlternately) {
  Surface_report report;
  check_surface(test::join(box({-9, -9, -9}, {9, 9, 9}), octahedron()), "surface", &report);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.turned_facets, 8u);
  EXPECT_DOUBLE_EQ(report.volume, 18 * 18 * 18 - 4.0 / 3);
}

TEST(SurfaceCheck, MergesPointsAndDropsWhatCollapses) {
  // A triangle soup as STL has it: every facet with its own three points; one more that is a point twice; one
  // unused.
  Surface_soup s;
  for (const auto& f : octahedron().facets) {
    for (auto v : f) s.points.push_back(octahedron().points[v]);
    const auto n = static_cast<std::uint32_t>(s.points.size());
    s.facets.push_back({n - 3, n - 2, n - 1});
  }
  s.facets.push_back({0, 1, 0});
  s.points.push_back({7, 7, 7});
  Surface_report report;
  EXPECT_EQ(check_surface(s, "surface", &report).points.size(), 6u);
  EXPECT_EQ(report.merged_points, 18u);
  EXPECT_EQ(report.collapsed_facets, 1u);
  EXPECT_EQ(report.unused_points, 1u);
  EXPECT_EQ(describe(report)[0], "18 duplicate vertices merged");
}

TEST(SurfaceCheck, RefusesEmptyAndMalformedSurfaces) {
  EXPECT_EQ(why({}), "3: surface is empty: it has no facets; give a closed surface");
  auto s = octahedron();
  s.facets[2][1] = 6;
  EXPECT_EQ(why(s), "3: surface is malformed: facet 2 names vertex 6 of 6");
  s = octahedron();
  s.points[4][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(why(s), "3: surface has a vertex that is not finite: vertex 4");
  s.points[4] = s.points[1];
  for (auto& f : s.facets) f = {1, 4, 1};
  EXPECT_EQ(why(s), "3: surface is empty: every facet collapses to a point or an edge");
  s = box({0, 0, 0}, {1, 1, 1});
  s.facets[0] = {0, 2, 3, 2, 1};
  EXPECT_EQ(why(s), "3: surface is malformed: facet 0 passes vertex 2 twice; cut it into simple polygons");
}

TEST(SurfaceCheck, RefusesOpenSurfaces) {
  auto s = octahedron();
  s.facets.erase(s.facets.begin());
  EXPECT_EQ(why(s),
            "3: surface is open: 3 boundary edges, the first between vertices 0 and 1; "
            "close its holes so that it bounds a volume");
}

TEST(SurfaceCheck, RefusesEdgesOfMoreThanTwoFacets) {
  // Two tetrahedra that share an edge.
  Surface_soup s;
  s.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  s.facets = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 1}, {0, 5, 4}, {0, 1, 5}, {1, 4, 5}};
  EXPECT_EQ(why(s),
            "3: surface is not manifold: more than two facets meet at 1 edge, the first between vertices 0 "
            "and 1; separate the sheets that meet there");
}

TEST(SurfaceCheck, RefusesVerticesOfTwoSheets) {
  auto s = test::join(octahedron(), octahedron());
  for (std::size_t v = 6; v < 12; ++v) s.points[v][0] += 2;  // point 9 falls on point 0
  EXPECT_EQ(
      why(s),
      "3: surface is not manifold: separate sheets meet at 1 vertex, the first vertex 0; pull the sheets "
      "apart there");
}

TEST(SurfaceCheck, RefusesFacetsThatAreRepeatedOrDegenerate) {
  Surface_soup pillow;
  pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.facets = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_EQ(why(pillow),
            "3: surface has a facet twice: facets 0 and 1 have the same vertices; remove one or both");
  // The middle of an edge joined to both ends only: facet {0, 6, 1} is flat.
  auto s = octahedron();
  s.points.push_back({0.5, 0.5, 0});
  s.facets[0] = {0, 6, 2};
  s.facets.push_back({6, 1, 2});
  s.facets.push_back({0, 1, 6});
  EXPECT_EQ(
      why(s),
      "3: surface has 1 degenerate facet, the first facet 9: its vertices lie on one line; collapse its "
      "shortest edge or flip its longest");
}

TEST(SurfaceCheck, RefusesOneSidedSurfaces) {
  // The projective plane of six vertices.
  Surface_soup s;
  s.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}, {3, 1, 2}};
  s.facets = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
              {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  EXPECT_NE(why(s).find("3: surface is not orientable: facets "), std::string::npos) << why(s);
}

TEST(SurfaceCheck, RefusesSelfIntersections) {
  auto s = test::join(octahedron(), octahedron());
  for (std::size_t v = 6; v < 12; ++v) s.points[v][0] += 1.75;
  const auto message = why(s);
  EXPECT_NE(message.find("3: surface intersects itself: "), std::string::npos) << message;
  EXPECT_NE(message.find(" pairs of facets, the first facets 0 and "), std::string::npos) << message;
}

}  // namespace
}  // namespace cellwalk
