// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/meshing/triangulate.h>

#include <gtest/gtest.h>

#include <limits>

#include "environment/soup_checks.h"
#include "meshing/shapes.h"

namespace cellwalk {
namespace {

using test::refusal;

/// Appends a closed polygon.
void add(Planar_domain& domain, const std::vector<Point<2>>& polygon) {
  const auto n = static_cast<std::uint32_t>(domain.points.size()),
             k = static_cast<std::uint32_t>(polygon.size());
  domain.points.insert(domain.points.end(), polygon.begin(), polygon.end());
  for (std::uint32_t i = 0; i < k; ++i) domain.segments.push_back({n + i, n + (i + 1) % k});
}

Planar_domain square(double size) {
  Planar_domain domain;
  add(domain, {{0, 0}, {size, 0}, {size, size}, {0, size}});
  return domain;
}

void expect_sound(const Cell_soup<2>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) ASSERT_EQ(test::flaw(soup, c), "") << "cell " << c;
  EXPECT_EQ(test::count_facets(soup).crowded, 0u);
}

TEST(Triangulate, FillsAPolygonThatIsNotConvex) {
  Planar_domain domain;
  add(domain, {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  const auto soup = triangulate(domain);
  expect_sound(soup);
  EXPECT_EQ(soup.cell_count(), 3u);
  EXPECT_EQ(test::volume(soup), 10);
}

TEST(Triangulate, LeavesOutHolesOrKeepsThemSolid) {
  auto domain = square(8);
  add(domain, {{2, 2}, {4, 2}, {4, 4}, {2, 4}});
  domain.holes = {{3, 3}};
  const auto hollow = triangulate(domain);
  expect_sound(hollow);
  EXPECT_EQ(test::volume(hollow), 60);
  Triangulate_report report;
  const auto filled = triangulate(domain, {true}, &report);
  expect_sound(filled);
  EXPECT_EQ(test::volume(filled), 64);
  EXPECT_EQ(report.solid_cells, 2u);
  EXPECT_EQ(report.walls, 0u);
}

TEST(Triangulate, InnerSegmentsBecomeMembranes) {
  auto domain = square(8);
  // A wall with a free end, from the middle of the lower side.
  domain.points.push_back({4, 0});
  domain.points.push_back({4, 5});
  domain.segments.push_back({4, 5});
  Triangulate_report report;
  const auto soup = triangulate(domain, {}, &report);
  expect_sound(soup);
  EXPECT_EQ(report.walls, 1u);
  std::size_t inner_walls = 0, outer_walls = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    if (soup.impassable[f]) {
      const auto& a = soup.points[soup.facet(f)[0]];
      const auto& b = soup.points[soup.facet(f)[1]];
      ++(a[0] == 4 && b[0] == 4 ? inner_walls : outer_walls);
    }
  EXPECT_EQ(inner_walls, 2u);  // both sides
  EXPECT_EQ(outer_walls, 5u);  // the lower side is in two parts
}

TEST(Triangulate, RepairsAndReportsWhatIsGivenTwice) {
  auto domain = square(8);
  domain.points.push_back({8, 0});   // on point 1
  domain.points.push_back({99, 9});  // unused
  domain.segments[1] = {4, 2};
  domain.segments.push_back({2, 1});
  domain.segments.push_back({1, 4});
  domain.holes = {{-1, -1}};
  Triangulate_report report;
  const auto soup = triangulate(domain, {}, &report);
  expect_sound(soup);
  EXPECT_EQ(soup.points.size(), 4u);
  EXPECT_EQ(report.merged_points, 1u);
  EXPECT_EQ(report.unused_points, 1u);
  EXPECT_EQ(report.dropped_segments, 2u);
  EXPECT_EQ(report.outer_holes, 1u);
}

TEST(Triangulate, AllowsOverlappingSegments) {
  auto domain = square(8);
  add(domain, {{2, 0}, {6, 0}, {4, 3}});  // stands on the lower side
  domain.holes = {{4, 1}};
  const auto soup = triangulate(domain);
  expect_sound(soup);
  EXPECT_EQ(test::volume(soup), 58);
}

TEST(Triangulate, RefusesWhatItCannotUse) {
  const auto why = [](const Planar_domain& d) { return refusal([&] { triangulate(d); }); };
  EXPECT_EQ(why({}), "3: planar domain: it has no segments; give its boundary");
  auto domain = square(8);
  domain.segments.push_back({0, 9});
  EXPECT_EQ(why(domain), "3: planar domain: segment 4 names point 9 of 4");
  domain = square(8);
  domain.segments.pop_back();
  EXPECT_EQ(why(domain), "3: planar domain: its segments enclose nothing outside holes; close its boundary");
  domain = square(8);
  domain.points[2][0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(why(domain), "3: planar domain: point 2 is not finite");
  domain = square(8);
  domain.holes = {{8, 4}};
  EXPECT_EQ(why(domain), "3: planar domain: the point of hole 0 lies on a segment; move it inside the hole");
  domain = square(8);
  domain.segments.push_back({0, 2});
  domain.segments.push_back({1, 3});
  EXPECT_EQ(why(domain), "3: planar domain: segments 4 and 5 cross; split both at a common point");
  Planar_domain line;
  line.points = {{0, 0}, {1, 0}, {2, 0}};
  line.segments = {{0, 1}, {1, 2}};
  EXPECT_EQ(why(line),
            "3: planar domain: its segments lie on one line and enclose nothing; close its boundary");
}

}  // namespace
}  // namespace cellwalk
