// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "environment/soup_checks.h"
#include "meshing/shapes.h"

namespace cellwalk {
namespace {

using test::box;
using test::octahedron;
using test::refusal;

void expect_sound(const Cell_soup<3>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) ASSERT_EQ(test::flaw(soup, c), "") << "cell " << c;
  EXPECT_EQ(test::count_facets(soup).crowded, 0u);
}

/// Triangles of the boundary as sets of points.
std::set<std::set<Point<3>>> boundary(const Cell_soup<3>& soup) {
  std::map<std::set<Point<3>>, int> sides;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    std::set<Point<3>> triangle;
    for (auto v : soup.facet(f)) triangle.insert(soup.points[v]);
    ++sides[triangle];
  }
  std::set<std::set<Point<3>>> once;
  for (const auto& [triangle, n] : sides)
    if (n == 1) once.insert(triangle);
  return once;
}

std::set<std::set<Point<3>>> triangles(const Surface_soup& s) {
  std::set<std::set<Point<3>>> result;
  for (const auto& f : s.facets) result.insert({s.points[f[0]], s.points[f[1]], s.points[f[2]]});
  return result;
}

TEST(Tetrahedralize, KeepsTheBoundary) {
  ASSERT_TRUE(has_tetgen());
  const auto surface = octahedron(2);
  Tetrahedralize_report report;
  const auto soup = tetrahedralize(surface, {}, {}, &report);
  expect_sound(soup);
  EXPECT_EQ(boundary(soup), triangles(surface));
  EXPECT_EQ(report.boundary_facets, surface.facets.size());
  EXPECT_DOUBLE_EQ(test::volume(soup), 4.0 / 3);
}

TEST(Tetrahedralize, LeavesOutObstacles) {
  const auto hollow = tetrahedralize(box({-2, -2, -2}, {2, 2, 2}), {octahedron(1)});
  expect_sound(hollow);
  EXPECT_DOUBLE_EQ(test::volume(hollow), 64 - 4.0 / 3);
  EXPECT_EQ(boundary(hollow).size(), 12u + 32);

  Tetrahedralize_options options;
  options.keep_obstacles = true;
  Tetrahedralize_report report;
  const auto filled = tetrahedralize(box({-2, -2, -2}, {2, 2, 2}), {octahedron(1)}, options, &report);
  expect_sound(filled);
  EXPECT_DOUBLE_EQ(test::volume(filled), 64);
  EXPECT_EQ(report.boundary_facets, 12u + 32);
  EXPECT_EQ(report.solid_cells, filled.cell_count() - hollow.cell_count());
  for (std::size_t c = 0; c < filled.cell_count(); ++c)
    for (auto f = filled.cell_begin[c]; f < filled.cell_begin[c + 1]; ++f)
      EXPECT_GE(filled.impassable[f], filled.solid[c]);
}

TEST(Tetrahedralize, NestedComponentsAlternate) {
  auto inner = octahedron();
  for (auto& p : inner.points) p = 0.5 * p;
  const auto soup = tetrahedralize(test::join(test::join(box({-2, -2, -2}, {2, 2, 2}), octahedron()), inner));
  expect_sound(soup);
  EXPECT_DOUBLE_EQ(test::volume(soup), 64 - 4.0 / 3 + 4.0 / 24);
}

TEST(Tetrahedralize, RefinesOnRequestWithoutTouchingTheSurface) {
  Tetrahedralize_options options;
  options.quality = 2;
  options.cell_size = 0.25;
  Tetrahedralize_report report;
  const auto soup = tetrahedralize(octahedron(2), {}, options, &report);
  expect_sound(soup);
  EXPECT_GT(report.added_points, 10u);
  EXPECT_EQ(boundary(soup), triangles(octahedron(2)));
}

/// A tetrahedron of a soup: the four points, from those of its first two facets.
std::array<Point<3>, 4> corners(const Cell_soup<3>& soup, std::size_t cell) {
  const auto f = soup.facet(soup.cell_begin[cell]), g = soup.facet(soup.cell_begin[cell] + 1);
  const auto at = [&soup](std::uint32_t v) { return soup.points[v]; };
  return {at(f[0]), at(f[1]), at(f[2]), at(g[2])};
}

double volume(const std::array<Point<3>, 4>& t) {
  return std::abs(dot(t[1] - t[0], cross(t[2] - t[0], t[3] - t[0]))) / 6;
}

/// Circumradius over shortest edge, by the formula of Crelle: for the products of opposite edges as the sides
/// of a triangle of area A, the radius is A / (6 V).
double radius_edge(const std::array<Point<3>, 4>& t) {
  const auto edge = [&t](int i, int j) { return length(t[i] - t[j]); };
  const double a = edge(0, 1) * edge(2, 3), b = edge(0, 2) * edge(1, 3), c = edge(0, 3) * edge(1, 2);
  const double area = std::sqrt((a + b + c) * (-a + b + c) * (a - b + c) * (a + b - c)) / 4;
  return area / (6 * volume(t)) /
         std::min({edge(0, 1), edge(0, 2), edge(0, 3), edge(1, 2), edge(1, 3), edge(2, 3)});
}

TEST(Tetrahedralize, CountsTetrahedraOutOfBounds) {
  // The octahedron stands so near the ceiling that no point fits between.
  const auto room = box({-2, -2, -2}, {2, 2, 1.01});
  std::size_t violations = 0, meshes = 0;
  for (const double quality : {0.0, 1.2, 2.5, 1000.0})
    for (const double size : {0.0, 0.5, 1.5, 20.0}) {
      Tetrahedralize_options options;
      options.quality = quality;
      options.cell_size = size;
      Tetrahedralize_report report;
      const auto soup = tetrahedralize(room, {octahedron(1)}, options, &report);
      std::size_t expected = 0;
      for (std::size_t c = 0; c < soup.cell_count(); ++c) {
        const auto t = corners(soup, c);
        const double largest = 8 / (9 * std::sqrt(3.0)) * size * size * size;
        expected += (quality > 0 && radius_edge(t) > quality * (1 + 1e-9)) ||
                    (size > 0 && volume(t) > largest * (1 + 1e-9));
      }
      EXPECT_EQ(report.out_of_bounds, expected) << quality << " " << size;
      violations += expected > 0;
      meshes += expected == 0;
      EXPECT_TRUE(quality > 0 || size > 0 || expected == 0);
    }
  EXPECT_GE(violations, 2u);
  EXPECT_GE(meshes, 2u);
}

TEST(Tetrahedralize, AddsNoPointWithoutNeedOrBound) {
  const auto room = box({-2, -2, -2}, {2, 2, 2});
  Tetrahedralize_options none;
  none.quality = 0;
  Tetrahedralize_report report, report_of_none;
  const auto fine = tetrahedralize(room, {octahedron(4)}, {}, &report);
  const auto coarse = tetrahedralize(room, {octahedron(4)}, none, &report_of_none);
  EXPECT_EQ(boundary(fine), boundary(coarse));
  EXPECT_EQ(report_of_none.added_points, 0u);
  EXPECT_GT(report.added_points, 0u);
}

TEST(Tetrahedralize, SaysWhereObstaclesAreWrong) {
  const auto room = box({-2, -2, -2}, {2, 2, 2});
  EXPECT_EQ(refusal([&] {
              tetrahedralize(room, {box({3, 3, 3}, {4, 4, 4})});
            }),
            "3: obstacle 1 does not lie inside the surface; move it, or leave it out");
  const auto across = refusal([&] {
    tetrahedralize(room, {octahedron(), box({1.5, 1, 1}, {2.5, 1.5, 1.5})});
  });
  EXPECT_NE(across.find("3: obstacle 2 meets surface: "), std::string::npos) << across;
  EXPECT_EQ(refusal([&] {
              tetrahedralize(room, {octahedron(), box({-.1, -.1, -.1}, {.1, .1, .1})});
            }),
            "3: obstacle 2 lies inside obstacle 1; leave it out");
  auto open = octahedron();
  open.facets.pop_back();
  EXPECT_NE(refusal([&] { tetrahedralize(room, {open}); }).find("3: obstacle 1 is open: "),
            std::string::npos);
}

TEST(Tetrahedralize, RefusesOptionsOutOfRange) {
  Tetrahedralize_options options;
  options.quality = 0.5;
  EXPECT_EQ(refusal([&] { tetrahedralize(octahedron(), {}, options); }).substr(0, 2), "2:");
  options.quality = 0;
  options.cell_size = -1;
  EXPECT_EQ(refusal([&] { tetrahedralize(octahedron(), {}, options); }).substr(0, 2), "2:");
  options.cell_size = 1e-3;
  EXPECT_EQ(refusal([&] {
              tetrahedralize(box({-1, -1, -1}, {1, 1, 1}), {}, options);
            }),
            "2: TetGen: a cell size of 0.001 is too small for a surface that holds a volume of 8: give at "
            "least 0.012");
  options.cell_size = 1e200;  // whose cube is infinite
  EXPECT_NO_THROW(tetrahedralize(octahedron(), {}, options));
}

TEST(Mesh3, ApproximatesTheSurfaceAndSaysHowWell) {
  Mesh3_options options;
  options.cell_size = 0.3;
  options.facet_distance = 0.02;
  Mesh3_report report;
  const auto surface = box({-1, -1, -1}, {1, 1, 1});
  auto obstacle = octahedron();
  for (auto& p : obstacle.points) p = 0.5 * p;
  const auto soup = mesh3(surface, {obstacle}, options, &report);
  expect_sound(soup);
  EXPECT_EQ(test::count_facets(soup).boundary, report.boundary_facets);
  EXPECT_NEAR(test::volume(soup), 8 - 4.0 / 24, 0.4);
  EXPECT_GT(report.distance_to_surface, 0);
  EXPECT_LT(report.distance_to_surface, 0.1);
  EXPECT_GT(report.distance_from_surface, 0);  // corners are cut
  EXPECT_LT(report.distance_from_surface, 0.3);
  EXPECT_EQ(test::hash(soup), test::hash(mesh3(surface, {obstacle}, options)));
}

TEST(Mesh3, RefusesOptionsOutOfRange) {
  for (auto set :
       {+[](Mesh3_options& o) { o.cell_size = -1; }, +[](Mesh3_options& o) { o.facet_angle = 45; },
        +[](Mesh3_options& o) { o.radius_edge = 1; }, +[](Mesh3_options& o) { o.cell_size = 1e-4; },
        +[](Mesh3_options& o) { o.facet_size = 1e-5; }, +[](Mesh3_options& o) { o.facet_distance = 1e-7; }}) {
    Mesh3_options options;
    set(options);
    EXPECT_EQ(refusal([&] { mesh3(octahedron(), {}, options); }).substr(0, 2), "2:");
  }
}

}  // namespace
}  // namespace cellwalk
