// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/generators/implicit.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

/// How many parts the cells fall into when joined through facets.
std::size_t component_count(const Cell_soup<3>& soup, const Gluing& gluing) {
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) cell_of[f] = c;
  std::vector<bool> seen(soup.cell_count(), false);
  std::size_t components = 0;
  for (std::uint32_t seed = 0; seed < soup.cell_count(); ++seed) {
    if (seen[seed]) continue;
    ++components;
    std::vector<std::uint32_t> stack{seed};
    seen[seed] = true;
    while (!stack.empty()) {
      const auto c = stack.back();
      stack.pop_back();
      for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
        if (gluing.opposite[f] == no_facet || seen[cell_of[gluing.opposite[f]]]) continue;
        seen[cell_of[gluing.opposite[f]]] = true;
        stack.push_back(cell_of[gluing.opposite[f]]);
      }
    }
  }
  return components;
}

/// Sound cells, in one part, with a boundary that is one closed surface of the given Euler characteristic.
void expect_solid(const Cell_soup<3>& soup, int characteristic) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const auto base = soup.facet(soup.cell_begin[c]), side = soup.facet(soup.cell_begin[c] + 1);
    ASSERT_EQ(soup.cell_begin[c + 1] - soup.cell_begin[c], 4u);
    ASSERT_EQ(test::sign(soup, base[0], base[2], base[1], side[2]), 1) << "cell " << c;
  }
  const Gluing gluing = glue(soup);
  EXPECT_EQ(component_count(soup, gluing), 1u);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::set<std::uint32_t> vertices;
  int triangles = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    if (gluing.opposite[f] != no_facet) continue;
    ++triangles;
    const auto loop = soup.facet(f);
    for (int i = 0; i < 3; ++i) {
      ++edges[std::minmax(loop[i], loop[(i + 1) % 3])];
      vertices.insert(loop[i]);
    }
  }
  for (const auto& [edge, n] : edges) ASSERT_EQ(n, 2) << "boundary edge " << edge.first << " " << edge.second;
  EXPECT_EQ(static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + triangles, characteristic);
}

/// The smallest angle between two facets of a cell, in degrees.
double smallest_angle(const Cell_soup<3>& soup) {
  double largest_cosine = -1;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    std::array<Vector<3>, 4> normal;
    for (int i = 0; i < 4; ++i) {
      const auto loop = soup.facet(soup.cell_begin[c] + i);
      const auto n =
          cross(soup.points[loop[1]] - soup.points[loop[0]], soup.points[loop[2]] - soup.points[loop[0]]);
      normal[i] = (1 / length(n)) * n;
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) largest_cosine = std::max(largest_cosine, -dot(normal[i], normal[j]));
  }
  return std::acos(largest_cosine) * 180 / 3.14159265358979;
}

TEST(FillImplicit, FillsABall) {
  Implicit_shape ball;
  ball.depth = [](const Point<3>& p) { return 1 - length(p); };
  ball.low = {-1, -1, -1}, ball.high = {1, 1, 1};
  ball.cell_size = 0.2;
  const auto soup = fill_implicit(ball);
  expect_solid(soup, 2);
  EXPECT_NEAR(test::volume(soup), 4.18879, 0.05);
  EXPECT_GT(smallest_angle(soup), 5);
  // The boundary lies on the surface.
  const Gluing gluing = glue(soup);
  double worst = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    if (gluing.opposite[f] == no_facet)
      for (auto v : soup.facet(f)) worst = std::max(worst, std::abs(1 - length(soup.points[v])));
  EXPECT_LT(worst, 1e-3);
}

TEST(FillImplicit, AllowsTheSurfaceToPassThroughLatticePoints) {
  Implicit_shape cube;
  cube.depth = [](const Point<3>& p) {
    return 1 - std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  };
  cube.low = {-1, -1, -1}, cube.high = {1, 1, 1};
  cube.cell_size = 0.5;
  const auto soup = fill_implicit(cube);
  expect_solid(soup, 2);
  EXPECT_NEAR(test::volume(soup), 8, 0.3);
}

TEST(FillImplicit, RefusesWhatItCannotFill) {
  Implicit_shape shape;
  shape.depth = [](const Point<3>&) { return -1.0; };
  shape.low = {0, 0, 0}, shape.high = {1, 1, 1};
  EXPECT_THROW(fill_implicit(shape), Error);
  shape.cell_size = 0;
  EXPECT_THROW(fill_implicit(shape), Error);
  shape.cell_size = 1e-4;
  EXPECT_THROW(fill_implicit(shape), Error);
}

/// The cells that are free, or those that are solid, with their points.
Cell_soup<3> part(const Cell_soup<3>& soup, bool solid) {
  Cell_soup<3> result;
  result.points = soup.points;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    if ((soup.solid[c] != 0) != solid) continue;
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) result.add_facet(soup.facet(f));
    result.end_cell(solid);
  }
  return result;
}

/// The loops of a soup's facets on its boundary, each as the points in ascending order.
std::set<std::set<Point<3>>> boundary(const Cell_soup<3>& soup) {
  const Gluing gluing = glue(soup);
  std::set<std::set<Point<3>>> result;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    if (gluing.opposite[f] != no_facet) continue;
    std::set<Point<3>> points;
    for (const auto v : soup.facet(f)) points.insert(soup.points[v]);
    result.insert(points);
  }
  return result;
}

TEST(FillImplicit, SurroundsABallByTissue) {
  Implicit_shape ball;
  ball.depth = [](const Point<3>& p) { return 1 - length(p); };
  ball.low = {-1, -1, -1}, ball.high = {1, 1, 1};
  for (const double cell : {0.16, 0.19, 0.2, 0.25, 0.31}) {
    ball.cell_size = cell;
    ball.tissue = 0;
    const auto alone = fill_implicit(ball);
    for (const double tissue : {1.25 * cell, 0.5, 0.8}) {
      ball.tissue = tissue;
      const auto soup = fill_implicit(ball);
      expect_solid(soup, 2);
      EXPECT_NEAR(test::volume(soup), 4.18879 * std::pow(1 + tissue, 3), 0.09 * std::pow(1 + tissue, 3));
      EXPECT_GT(smallest_angle(soup), 5) << cell << " " << tissue;
      const auto inside = part(soup, false), outside = part(soup, true);
      expect_solid(inside, 2);
      EXPECT_EQ(inside.cell_count(), alone.cell_count()) << "the shape is filled as without tissue";
      EXPECT_NEAR(test::volume(inside), test::volume(alone), 1e-6);
      // Tissue has two boundaries: the surface of the shape, and its own.
      const auto walls = boundary(inside), all = boundary(soup), both = boundary(outside);
      EXPECT_EQ(both.size(), walls.size() + all.size());
      for (const auto& facet : walls) EXPECT_TRUE(both.contains(facet));
      double worst = 0;
      for (const auto& facet : all)
        for (const auto& x : facet) worst = std::max(worst, std::abs(1 + tissue - length(x)));
      EXPECT_LT(worst, 1e-3);
    }
  }
}

TEST(FillImplicit, RefusesTissueThinnerThanCells) {
  Implicit_shape ball;
  ball.depth = [](const Point<3>& p) { return 1 - length(p); };
  ball.low = {-1, -1, -1}, ball.high = {1, 1, 1};
  ball.cell_size = 0.2;
  for (const double tissue : {0.24, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ball.tissue = tissue;
    EXPECT_THROW(fill_implicit(ball), Error) << tissue;
  }
  // A depth that grows four times as fast as the distance.
  ball.depth = [](const Point<3>& p) { return 4 * (1 - length(p)); };
  ball.tissue = 0.25;
  EXPECT_THROW(fill_implicit(ball), Error);
}

TEST(BranchingVessel, IsOneTreeOfTubes) {
  const auto soup = branching_vessel({});
  expect_solid(soup, 2);  // a tree has no handles
  EXPECT_GT(soup.cell_count(), 20000u);
  EXPECT_LT(soup.cell_count(), 60000u);
  EXPECT_GT(smallest_angle(soup), 3);
}

TEST(BranchingVessel, HasCentreLinesInside) {
  Vessel_options options;
  options.radius = 0.01;
  options.generations = 2;
  const auto tubes = vessel_tubes(options);
  EXPECT_EQ(tubes.size(), 7u);
  for (int i = 1; i < 7; ++i) {
    EXPECT_LT(tubes[i].parent, i);
    EXPECT_EQ(tubes[i].points.front(), tubes[tubes[i].parent].points.back());
    EXPECT_LT(tubes[i].radii.front(), tubes[tubes[i].parent].radii.back());
  }
  EXPECT_EQ(tubes[0].points.front(), (Point<3>{0, 0, 0}));
  const auto soup = branching_vessel(options);
  expect_solid(soup, 2);
}

TEST(BranchingVessel, DependsOnItsSeedOnly) {
  Vessel_options options;
  options.generations = 1;
  const auto hash = test::hash(branching_vessel(options));
  EXPECT_EQ(hash, 13722300209441435146u);
  options.seed = 2;
  EXPECT_NE(test::hash(branching_vessel(options)), hash);
}

TEST(BranchingVessel, RefusesOptionsOutOfRange) {
  for (auto set : {+[](Vessel_options& o) { o.generations = 9; }, +[](Vessel_options& o) { o.length = 1; },
                   +[](Vessel_options& o) { o.curvature = 2; }, +[](Vessel_options& o) { o.radius = 0; },
                   +[](Vessel_options& o) { o.cell_size = 0.6; }, +[](Vessel_options& o) { o.tissue = 0.3; },
                   +[](Vessel_options& o) { o.tissue = -1; }}) {
    Vessel_options options;
    set(options);
    EXPECT_THROW(branching_vessel(options), Error);
  }
}

TEST(BranchingVessel, LiesInTissue) {
  Vessel_options options;
  options.generations = 2;
  options.radius = 0.5;
  for (const std::uint64_t seed : {1, 2, 3}) {
    options.seed = seed;
    options.tissue = 0;
    const auto alone = branching_vessel(options);
    options.tissue = 0.4;
    const auto soup = branching_vessel(options);
    const auto inside = part(soup, false);
    expect_solid(inside, 2);
    EXPECT_EQ(inside.cell_count(), alone.cell_count());
    EXPECT_NEAR(test::volume(inside), test::volume(alone), 1e-6);
    const auto walls = boundary(inside), all = boundary(soup);
    EXPECT_EQ(boundary(part(soup, true)).size(), walls.size() + all.size()) << "no wall is on the boundary";
    EXPECT_GT(smallest_angle(soup), 3);
  }
  // Thick tissue ends at its distance, too.
  options.generations = 0;
  options.tissue = 3;
  const auto line = vessel_tubes(options)[0].points;
  for (const auto& facet : boundary(branching_vessel(options)))
    for (const auto& x : facet) {
      double nearest = 99;
      for (const auto& p : line) nearest = std::min(nearest, length(x - p));
      ASSERT_LT(nearest, 0.5 + 1.5 + 0.05);
    }
}

TEST(BulgingTube, IsOneTube) {
  const auto with = bulging_tube({});
  expect_solid(with, 2);
  Bulge_options options;
  options.bulge_radius = 0;
  const auto without = bulging_tube(options);
  expect_solid(without, 2);
  EXPECT_GT(test::volume(with), test::volume(without) + 10);
  EXPECT_EQ(test::hash(without), 10972751635593088228u);
  options.tissue = 0.375;
  EXPECT_GT(bulging_tube(options).cell_count(), without.cell_count());
  options.tissue = 0.37;
  EXPECT_THROW(bulging_tube(options), Error);
}

}  // namespace
}  // namespace cellwalk
