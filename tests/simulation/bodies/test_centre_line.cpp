// SPDX-License-Identifier: LGPL-3.0-or-later
// Centre lines: in the middle, free by exact walks, along the wider way, and refused with the reason.
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/centre_line.h>
#include <cellwalk/internal/simulation/world.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "simulation/worlds.h"

namespace cellwalk {
namespace {

using test::rooms;

/// The boundary facets of free cells with centroids in a box.
template <int D>
Selection<D> side(const Snapshot<D>& snapshot, const Point<D>& low, const Point<D>& high) {
  Selection<D> result;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const Point<D> x = centroid(snapshot, f);
      bool is_inside = snapshot.neighbour(f) == Cell::none && !snapshot.is_solid(c);
      for (std::size_t axis = 0; axis < D; ++axis)
        is_inside = is_inside && low[axis] <= x[axis] && x[axis] <= high[axis];
      if (is_inside) result.facets.push_back(f);
    }
  }
  EXPECT_FALSE(result.facets.empty());
  return result;
}

/// A point can follow the line, and the walls are as far as it says from each of its points.
template <int D>
void expect_free_line(const Snapshot<D>& snapshot, const Centre_line<D>& line) {
  ASSERT_GE(line.points.size(), 2u);
  ASSERT_EQ(line.clearances.size(), line.points.size());
  auto particle = Locator<D>(snapshot).particle_at(line.points.front()).value();
  Walk_counts counts;
  for (const Point<D>& p : line.points)
    EXPECT_EQ(move<Exact>(snapshot, particle, p, counts).status, Walk_status::arrived);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) EXPECT_NE(line.points[i], line.points[i + 1]);
}

template <int D>
std::string refused(const Snapshot<D>& snapshot, const Groups<D>& groups, const Catheter_ends<D>& ends,
                    Error_code code, double radius = 0) {
  try {
    find_centre_line(snapshot, groups, ends, radius);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "a line was found";
  return {};
}

TEST(CentreLine, EndsKeepARadiusFromTheirGroups) {
  const auto snapshot = rooms<3>({12, 4, 4});
  const Groups<3> groups{{"cap_1", side<3>(snapshot, {0, 0, 0}, {0, 4, 4})},
                         {"cap_2", side<3>(snapshot, {12, 0, 0}, {12, 4, 4})}};
  for (const double radius : {0.1, 1., 1.5}) {
    const auto line = find_centre_line<3>(snapshot, groups, {"cap_1", "cap_2"}, radius);
    expect_free_line(snapshot, line);
    for (const auto& [x, y, z] : {line.points.front(), line.points.back()})
      EXPECT_GE(std::min({x, 12 - x, y, 4 - y, z, 4 - z}), radius);
    EXPECT_GT(line.length(), 12 - 2 * radius - 2.1) << "pieces are 1 long";
  }
  EXPECT_EQ(refused(snapshot, groups, {"cap_1", "cap_2"}, Error_code::outside, 2.5),
            "radius: no point of the centre line from cap_1 to cap_2 is 2.5 away from all walls; the widest "
            "place has 2: give a smaller radius, or a path");
}

TEST(CentreLine, KeepsToTheAxisOfAStraightDuct) {
  const auto snapshot = rooms<3>({12, 4, 4});
  const Groups<3> groups{{"cap_1", side<3>(snapshot, {0, 0, 0}, {0, 4, 4})},
                         {"cap_2", side<3>(snapshot, {12, 0, 0}, {12, 4, 4})}};
  const auto line = find_centre_line<3>(snapshot, groups, {"cap_1", "cap_2"});
  expect_free_line(snapshot, line);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const auto& [x, y, z] = line.points[i];
    EXPECT_LT(std::hypot(y - 2, z - 2), 0.05) << "at " << x;
    EXPECT_NEAR(line.clearances[i], 2, 0.05) << "the ends are no walls";
  }
  EXPECT_LT(line.points.front()[0], 0.2);
  EXPECT_GT(line.points.back()[0], 11.8);
  EXPECT_LT(line.length(), 12.01);
}

/// The distance of a point from a polyline.
double distance(const Point<3>& x, const std::vector<Point<3>>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector<3> along = line[i + 1] - line[i];
    const double t = std::clamp(dot(x - line[i], along) / dot(along, along), 0.0, 1.0);
    least = std::min(least, length(x - (line[i] + t * along)));
  }
  return least;
}

TEST(CentreLine, KeepsToTheAxisOfTubes) {
  for (const double bend : {0.0, 0.4}) {
    Bulge_options options;
    options.bend = bend;
    options.bulge_radius = 0;
    const auto snapshot = test::compile(bulging_tube(options));
    const std::vector<Point<3>> axis = bulging_tube_line(options).points;
    const auto line = find_centre_line<3>(snapshot, {}, {axis.front(), axis.back()});
    expect_free_line(snapshot, line);
    EXPECT_GT(line.points.size(), 20u);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      EXPECT_LT(distance(line.points[i], axis), 0.1) << "of a radius of 1, with a bend of " << bend;
      EXPECT_GT(line.clearances[i], 0.8);
    }
  }
}

TEST(CentreLine, TakesTheBranchOfItsEnd) {
  Vessel_options options;
  options.generations = 1;
  const auto snapshot = test::compile(branching_vessel(options));
  const std::vector<Tube> tubes = vessel_tubes(options);
  ASSERT_EQ(tubes.size(), 3u);
  for (const std::size_t branch : {1, 2}) {
    const auto line =
        find_centre_line<3>(snapshot, {}, {tubes[0].points.front(), tubes[branch].points.back()});
    expect_free_line(snapshot, line);
    std::size_t in_branch = 0;
    for (const Point<3>& x : line.points) {
      const double from_own = distance(x, tubes[branch].points), from_trunk = distance(x, tubes[0].points);
      EXPECT_LT(std::min(from_own, from_trunk), 0.35) << "of a radius of 1";
      in_branch += from_own < from_trunk;
    }
    EXPECT_GT(in_branch, 5u);
  }
}

/// A corridor with two bends, as a Z.
const std::vector<std::uint32_t> bends{5, 6, 7, 8, 16, 17, 18, 19};

TEST(CentreLine, GoesRoundBends) {
  const auto snapshot = rooms<2>({5, 5}, bends);
  const auto line = find_centre_line<2>(snapshot, {}, {Point<2>{0.5, 0.5}, Point<2>{4.5, 4.5}});
  expect_free_line(snapshot, line);
  EXPECT_EQ(line.points.front(), (Point<2>{0.5, 0.5}));
  EXPECT_EQ(line.points.back(), (Point<2>{4.5, 4.5}));
  EXPECT_GT(*std::ranges::min_element(line.clearances), 0.35) << "half of a corridor of width 1 is 0.5";
}

TEST(CentreLine, PrefersTheWiderWay) {
  // Two ways round a block: one of one cell, straight on, and one of three cells, longer.
  std::vector<std::uint32_t> block;
  for (std::uint32_t y = 1; y < 4; ++y)
    for (std::uint32_t x = 3; x < 9; ++x) block.push_back(x + 12 * y);
  const auto snapshot = rooms<2>({12, 7}, block);
  const auto line = find_centre_line<2>(snapshot, {}, {Point<2>{1.5, 0.5}, Point<2>{10.5, 0.5}});
  expect_free_line(snapshot, line);
  double highest = 0;
  for (const Point<2>& x : line.points) highest = std::max(highest, x[1]);
  EXPECT_GT(highest, 5);
  EXPECT_GT(line.length(), 12);
}

TEST(CentreLine, PassesNarrowHolesOffItsWay) {
  // Two walls, each with a hole far narrower than the pieces of the line, at different heights.
  Grid_options<2> options;
  options.cells = {12, 9};
  for (std::uint32_t y = 0; y < 9; ++y) {
    if (y != 2) options.solid_cells.push_back(4 + 12 * y);
    if (y != 6) options.solid_cells.push_back(8 + 12 * y);
  }
  Cell_soup<2> soup = square_grid(options);
  constexpr double hole = 0.05;
  for (Point<2>& x : soup.points) x[1] += (hole - 1) * ((x[1] > 2) + (x[1] > 6));
  const auto snapshot = test::compile(soup);
  const auto line = find_centre_line<2>(snapshot, {}, {Point<2>{0.5, 6}, Point<2>{11.5, 1}});
  expect_free_line(snapshot, line);
  EXPECT_NEAR(*std::ranges::min_element(line.clearances), hole / 2, 0.01);
  double longest = 0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    longest = std::max(longest, length(line.points[i + 1] - line.points[i]));
  EXPECT_GT(longest, 4 * hole);
}

TEST(CentreLine, IsFreeAmongObstacles) {
  Random random(5);
  int found = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    auto options = mixed_lattice_world<3>(seed);
    options.membrane_share = 0.3;
    const auto snapshot = test::compile(lattice_world(options));
    const Locator<3> locator(snapshot);
    std::vector<Point<3>> ends;
    while (ends.size() < 2) {
      const Point<3> x{random.real(0, 4), random.real(0, 4), random.real(0, 4)};
      if (locator.particle_at(x)) ends.push_back(x);
    }
    try {
      const auto line = find_centre_line<3>(snapshot, {}, {ends[0], ends[1]});
      expect_free_line(snapshot, line);
      EXPECT_EQ(line.points.front(), ends[0]);
      EXPECT_EQ(line.points.back(), ends[1]);
      ++found;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::outside);
      ++without;
    }
  }
  EXPECT_GE(found, 40);
  EXPECT_EQ(found + without, 60);
}

TEST(CentreLine, SaysWhyThereIsNone) {
  const auto snapshot = rooms<2>({4, 1}, {1});
  Groups<2> groups{{"cap_1", side<2>(snapshot, {0, 0}, {0, 1})},
                   {"cap_2", side<2>(snapshot, {4, 0}, {4, 1})}};
  groups["rock"].cells = {snapshot.cell(1)};
  EXPECT_EQ(refused<2>(snapshot, groups, {"cap_1", "cap_2"}, Error_code::outside),
            "to: no way leads from cap_1 to cap_2: they lie in different components of free space, of 1 and "
            "2 cells");
  EXPECT_EQ(refused<2>(snapshot, groups, {"inlet", "cap_2"}, Error_code::input),
            "from: there is no group \"inlet\"; there are cap_1, cap_2, rock");
  EXPECT_EQ(refused<2>(snapshot, {}, {Point<2>{0.5, 0.5}, "cap_2"}, Error_code::input),
            "to: there is no group \"cap_2\"; the environment has none: give a point");
  EXPECT_EQ(refused<2>(snapshot, groups, {"cap_1", "rock"}, Error_code::input),
            "to: group \"rock\" has no facet of a free cell");
  EXPECT_EQ(refused<2>(snapshot, groups, {"cap_1", Point<2>{1.5, 0.5}}, Error_code::outside),
            "to: (1.5, 0.5) lies in no free cell; put it into free space");
  EXPECT_EQ(refused<2>(snapshot, groups, {Point<2>{3, 0.5}, Point<2>{3, 0.5}}, Error_code::input),
            "to: (3, 0.5) is where the catheter enters");
}

TEST(CentreLine, ACatheterArrivesAlongIt) {
  const auto snapshot = rooms<3>({12, 4, 4});
  Scene<3> scene;
  scene.catheter.emplace();
  scene.catheter->ends = {"cap_1", "cap_2"};
  scene.catheter->spacing = scene.catheter->advance = 0;
  scene.catheter->particles = 0;
  const Groups<3> groups{{"cap_1", side<3>(snapshot, {0, 0, 0}, {0, 4, 4})},
                         {"cap_2", side<3>(snapshot, {12, 0, 0}, {12, 4, 4})}};
  lay_along_centre_line(snapshot, groups, *scene.catheter);
  EXPECT_NEAR(scene.catheter->spacing, 1, 0.02) << "half the distance from walls";
  EXPECT_EQ(scene.catheter->advance, scene.catheter->spacing / 2);
  EXPECT_GE(scene.catheter->particles * scene.catheter->spacing, 1.1 * 12) << "it may lie along walls";
  World<3> world(snapshot, scene);
  const Rod<3>& rod = *world.catheter();
  double before = 0;
  for (int i = 0; i < 12; ++i) {
    world.step();
    EXPECT_GE(rod.travelled(), before);
    before = rod.travelled();
  }
  EXPECT_NEAR(rod.travelled(), 0.5, 0.05);
  EXPECT_NEAR(static_cast<double>(rod.steps_left()), 12, 1.01);
  EXPECT_FALSE(rod.has_arrived());
  EXPECT_FALSE(rod.is_all_inside());
  for (int i = 0; i < 20 && !rod.has_arrived(); ++i) world.step();
  world.validate();
  EXPECT_TRUE(rod.has_arrived());
  EXPECT_EQ(rod.travelled(), 1);
  EXPECT_EQ(rod.steps_left(), 0u);
  EXPECT_GT(rod.tip()[0], 10.5);

  scene.catheter->particles = 5;
  World<3> shorter(snapshot, scene);
  for (int i = 0; i < 40; ++i) shorter.step();
  EXPECT_FALSE(shorter.catheter()->has_arrived());
  EXPECT_TRUE(shorter.catheter()->is_all_inside());
  EXPECT_NEAR(shorter.catheter()->travelled(), 4.0 / 12, 0.03);
}

}  // namespace
}  // namespace cellwalk
