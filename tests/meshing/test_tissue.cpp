// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/internal/meshing/tissue.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "environment/soup_checks.h"
#include "meshing/shapes.h"

namespace cellwalk {
namespace {

using test::box;
using test::octahedron;

/// The facets that belong to one cell, by their points.
std::set<std::set<Point<3>>> open_facets(const Cell_soup<3>& soup) {
  std::map<std::set<Point<3>>, int> sides;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    std::set<Point<3>> triangle;
    for (const auto v : soup.facet(f)) triangle.insert(soup.points[v]);
    ++sides[triangle];
  }
  std::set<std::set<Point<3>>> once;
  for (const auto& [triangle, n] : sides) {
    EXPECT_LE(n, 2);
    if (n == 1) once.insert(triangle);
  }
  return once;
}

double area(const std::set<Point<3>>& triangle) {
  const std::vector<Point<3>> p(triangle.begin(), triangle.end());
  return length(cross(p[1] - p[0], p[2] - p[0])) / 2;
}

/// Everything that is promised of tissue around cells.
void expect_surrounded(const Cell_soup<3>& cells, const Tissue_options& options) {
  Tissue_report report;
  const auto soup = surround_by_tissue(cells, options, &report);
  // The cells stay as they are, in front.
  ASSERT_GE(soup.cell_count(), cells.cell_count());
  EXPECT_EQ(report.solid_cells, soup.cell_count() - cells.cell_count());
  EXPECT_EQ(report.added_points, soup.points.size() - cells.points.size());
  for (std::size_t i = 0; i < cells.points.size(); ++i) ASSERT_EQ(soup.points[i], cells.points[i]);
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) ASSERT_EQ(soup.vertices[i], cells.vertices[i]);
  EXPECT_EQ(std::set<Point<3>>(soup.points.begin(), soup.points.end()).size(), soup.points.size());
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    ASSERT_EQ(test::flaw(soup, c), "") << "cell " << c;
    ASSERT_EQ(soup.solid[c], c < cells.cell_count() ? cells.solid[c] : 1);
  }
  // They fill the box, and their boundary is its sides.
  const Vector<3> size = report.high - report.low;
  EXPECT_NEAR(test::volume(soup), size[0] * size[1] * size[2], 1e-9 * size[0] * size[1] * size[2]);
  const auto before = open_facets(cells), after = open_facets(soup);
  EXPECT_EQ(report.inner_facets, before.size());
  double sum = 0;
  for (const auto& facet : after) {
    EXPECT_FALSE(before.contains(facet));
    sum += area(facet);
    bool is_on_side = false;
    for (std::size_t k = 0; k < 3; ++k)
      for (const double side : {report.low[k], report.high[k]})
        is_on_side |= std::ranges::all_of(facet, [&](const Point<3>& p) { return p[k] == side; });
    EXPECT_TRUE(is_on_side);
  }
  EXPECT_NEAR(sum, 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]), 1e-9 * sum);
  Point<3> low = cells.points[0], high = low;
  for (const auto& p : cells.points)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(report.low[k], low[k] - options.thickness);
    EXPECT_EQ(report.high[k], high[k] + options.thickness);
  }
}

TEST(Tissue, SurroundsCells) {
  const auto ball = tetrahedralize(octahedron(3));
  for (const double thickness : {0.1, 0.3, 1.0, 5.0}) {
    SCOPED_TRACE(thickness);
    expect_surrounded(ball, {.thickness = thickness});
    expect_surrounded(ball, {.thickness = thickness, .quality = 0});
  }
  Mesh3_options mesh;
  mesh.cell_size = 0.3;
  expect_surrounded(mesh3(octahedron(2), {}, mesh), {.thickness = 0.5});
}

TEST(Tissue, FillsCavitiesAndLeavesSolidCells) {
  const auto room = box({-2, -2, -2}, {2, 2, 2});
  expect_surrounded(tetrahedralize(room, {octahedron(1)}), {.thickness = 1});
  Tetrahedralize_options keep;
  keep.keep_obstacles = true;
  expect_surrounded(tetrahedralize(room, {octahedron(1)}, keep), {.thickness = 1});
  auto inner = octahedron();
  for (auto& p : inner.points) p = 0.5 * p;
  expect_surrounded(tetrahedralize(test::join(test::join(room, octahedron()), inner)), {.thickness = 1});
}

TEST(Tissue, SurroundsPartsThatShareLittle) {
  // Two tetrahedra that share nothing, an edge, a vertex.
  for (int shared = 0; shared < 3; ++shared) {
    SCOPED_TRACE(shared);
    Cell_soup<3> soup;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    add_tetrahedron(soup, 0, 1, 2, 3);
    if (shared == 0) {
      for (int i = 0; i < 4; ++i) soup.points.push_back(soup.points[i] + Vector<3>{2, 0, 0});
      add_tetrahedron(soup, 4, 5, 6, 7);
    } else {
      soup.points.push_back({-1, -0.25, 0});
      soup.points.push_back({-0.25, -1, 0});
      if (shared == 2) soup.points.push_back({0, 0, -1});
      shared == 1 ? add_tetrahedron(soup, 0, 4, 5, 3) : add_tetrahedron(soup, 0, 5, 4, 6);
    }
    expect_surrounded(soup, {.thickness = 1});
  }
}

TEST(Tissue, RefusesWhatCannotBeSurrounded) {
  const auto ball = tetrahedralize(octahedron(1));
  const auto refusal_of = [&](const Cell_soup<3>& soup, const Tissue_options& options) {
    try {
      surround_by_tissue(soup, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const double thickness :
       {0.0, -1.0, 1e-5, 1e-300, 1e4, 1e300, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_NE(refusal_of(ball, {.thickness = thickness}).find("tissue: "), std::string::npos) << thickness;
  EXPECT_NE(refusal_of(ball, {.thickness = 1, .quality = 1}).find("quality"), std::string::npos);
  EXPECT_NE(refusal_of({}, {}).find("no cells"), std::string::npos);
  auto far = ball;
  for (auto& p : far.points) p = p + Vector<3>{0x1p50, 0, 0};
  EXPECT_NE(refusal_of(far, {.thickness = 0.1}).find("double precision"), std::string::npos);
  Cell_soup<3> cube;
  for (int i = 0; i < 8; ++i) cube.points.push_back({i & 1 ? 1. : 0., i & 2 ? 1. : 0., i & 4 ? 1. : 0.});
  add_hexahedron(cube, {0, 1, 3, 2, 4, 5, 7, 6});
  EXPECT_NE(refusal_of(cube, {}).find("not a triangle"), std::string::npos);
}

}  // namespace
}  // namespace cellwalk
