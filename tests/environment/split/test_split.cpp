// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/environment/split.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "environment/cell_samples.h"
#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

using test::cube;
using test::exact_volume;
using test::prism;
using test::Rational;
using test::Sample_cell;

/// A grid of n^3 unit cubes whose inner points (or all of them) are moved at random by up to `jitter` along
/// each axis.
Cell_soup<3> jittered_grid(std::uint32_t n, double jitter, std::uint64_t seed, bool only_inner) {
  Cell_soup<3> soup = hex_grid({.cells = {n, n, n}});
  Random random(seed);
  for (Point<3>& p : soup.points) {
    bool is_inner = true;
    for (const double x : p) is_inner = is_inner && x > 0 && x < n;
    for (double& x : p) {
      const double move = random.real(-jitter, jitter);
      if (is_inner || !only_inner) x += move;
    }
  }
  return soup;
}

template <int D>
void expect_sound(const Cell_soup<D>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) ASSERT_EQ(test::flaw(soup, c), "") << "cell " << c;
  EXPECT_EQ(test::count_facets(soup).crowded, 0u);
  EXPECT_NO_THROW(glue(soup));
}

template <int D>
std::string refusal(const Cell_soup<D>& soup, Error_code code = Error_code::not_certified) {
  Split_report report;
  try {
    split(soup, report);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    return error.what();
  }
  return "not refused";
}

/// Schoenhardt's polyhedron: a twisted prism, its sides cut along the diagonals that fold inwards.
Sample_cell<3> schoenhardt() {
  Sample_cell<3> cell{{{4, 0, 0}, {-2, 3, 0}, {-2, -3, 0}, {3, 2, 4}, {-3, 2, 4}, {0, -4, 4}},
                      {{0, 2, 1}, {3, 4, 5}}};
  for (std::uint16_t i = 0; i < 3; ++i) {
    const auto next = static_cast<std::uint16_t>((i + 1) % 3);
    const auto up = static_cast<std::uint16_t>(i + 3), next_up = static_cast<std::uint16_t>(next + 3);
    cell.loops.push_back({i, next, next_up});
    cell.loops.push_back({i, next_up, up});
  }
  return cell;
}

TEST(Split, LeavesSoundCellsAlone) {
  const Cell_soup<3> grid = hex_grid({.cells = {3, 2, 2}, .solid_cells = {4}});
  Split_report report;
  std::vector<std::uint32_t> origin;
  EXPECT_EQ(test::hash(split(grid, report, &origin)), test::hash(grid));
  EXPECT_EQ(report.cells_split + report.cells_made + report.facets_triangulated + report.points_added, 0u);
  EXPECT_EQ(report.not_planar + report.not_convex, 0u);
  EXPECT_EQ(origin.size(), 12u);
  EXPECT_EQ(origin[7], 7u);
}

TEST(Split, CutsAJitteredGridConformingly) {
  const Cell_soup<3> grid = jittered_grid(5, 0.1, 1, true);
  Split_report report;
  std::vector<std::uint32_t> origin;
  const Cell_soup<3> result = split(grid, report, &origin);
  expect_sound(result);
  EXPECT_EQ(report.cells_split, 125u);
  EXPECT_EQ(report.not_planar, 125u);
  EXPECT_EQ(report.not_convex, 0u);
  EXPECT_EQ(report.facets_triangulated, 3u * 5 * 5 * 6);
  EXPECT_EQ(report.cells_made, result.cell_count());
  EXPECT_EQ(report.points_added, 0u);
  EXPECT_EQ(report.cells_made, 125u * 6);  // six to a hexahedron, from its lowest vertex
  EXPECT_EQ(test::count_facets(result).boundary, 2u * 6 * 25);
  EXPECT_EQ(exact_volume(result), Rational(6 * 125));
  ASSERT_EQ(origin.size(), result.cell_count());
  EXPECT_TRUE(std::is_sorted(origin.begin(), origin.end()));
  EXPECT_EQ(origin.back(), 124u);
}

TEST(Split, DoesNotSplitASoundNeighbour) {
  Cell_soup<3> grid = hex_grid({.cells = {4, 2, 2}});
  for (Point<3>& p : grid.points)
    if (p == Point<3>{1, 1, 1}) p = {1.125, 1.0625, 0.875};
  Split_report report;
  std::vector<std::uint32_t> origin;
  const Cell_soup<3> result = split(grid, report, &origin);
  expect_sound(result);
  EXPECT_EQ(report.cells_split, 8u);
  EXPECT_EQ(result.cell_count() - report.cells_made, 8u);
  std::map<std::size_t, int> facets;
  for (std::size_t c = 0; c < result.cell_count(); ++c)
    if (std::count(origin.begin(), origin.end(), origin[c]) == 1)
      ++facets[result.cell_begin[c + 1] - result.cell_begin[c]];
  // The four neighbours got one facet more, in two coplanar triangles; the four beyond are as they were.
  EXPECT_EQ(facets, (std::map<std::size_t, int>{{6, 4}, {7, 4}}));
  EXPECT_EQ(exact_volume(result), Rational(6 * 16));
}

TEST(Split, KeepsWallsAndSolidCells) {
  Cell_soup<3> grid = jittered_grid(3, 0.1, 2, true);
  grid.solid[13] = 1;
  std::size_t walls = 0;
  for (std::size_t f = 0; f < grid.facet_count(); ++f) {
    const bool wall = f / 6 == 13 || f % 5 == 0;
    grid.impassable[f] = wall;
    walls += wall;
  }
  Split_report report;
  std::vector<std::uint32_t> origin;
  const Cell_soup<3> result = split(grid, report, &origin);
  std::size_t walls_after = 0, solid = 0;
  for (std::size_t c = 0; c < result.cell_count(); ++c) {
    solid += result.solid[c];
    EXPECT_EQ(result.solid[c], grid.solid[origin[c]]);
    for (std::size_t f = result.cell_begin[c]; f < result.cell_begin[c + 1]; ++f) {
      if (!result.impassable[f]) continue;
      ++walls_after;
      const auto triangle = result.facet(f);
      bool lies_in_wall = false;
      for (std::size_t g = 6 * origin[c]; g < 6 * (origin[c] + 1u); ++g) {
        const auto quad = grid.facet(g);
        lies_in_wall |=
            grid.impassable[g] && std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
              return std::find(quad.begin(), quad.end(), v) != quad.end();
            });
      }
      EXPECT_TRUE(lies_in_wall);
    }
  }
  EXPECT_EQ(walls_after, 2 * walls);
  EXPECT_EQ(solid, 6u);
}

TEST(Split, CutsPlanarCellsThatAreNotConvex) {
  const Sample_cell<3> angle = prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  Split_report report;
  const Cell_soup<3> result = split(angle.soup(), report);
  expect_sound(result);
  EXPECT_EQ(exact_volume(result), Rational(6 * 3));
  EXPECT_EQ(report.not_convex, 1u);
  EXPECT_EQ(report.not_planar, 0u);
  EXPECT_EQ(report.facets_triangulated, 8u);
  // A pyramid pushed into a cube: only from below are all of its facets seen.
  Sample_cell<3> dented = cube();
  dented.points.push_back({1, 1, 1});
  dented.loops.erase(dented.loops.begin() + 1);
  dented.loops.insert(dented.loops.end(), {{4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}});
  const Cell_soup<3> below = split(dented.soup(), report);
  expect_sound(below);
  EXPECT_EQ(exact_volume(below), Rational(6 * 8 - 8));
}

TEST(Split, CutsFacetsWithVerticesInsideTheirSides) {
  // The roof's ridge sags by one ulp, so that the box is cut; vertex 0 lies inside a side, and no fan from it
  // will do.
  Sample_cell<3> box = prism({{1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 0}});
  box.points[8][2] = std::nextafter(1.0, 0.0);
  Split_report report;
  const Cell_soup<3> result = split(box.soup(), report);
  expect_sound(result);
  EXPECT_EQ(report.not_planar, 1u);
}

TEST(Split, AddsAPointWhereNoVertexSeesAll) {
  Split_report report;
  const Cell_soup<3> result = split(schoenhardt().soup(), report);
  expect_sound(result);
  EXPECT_EQ(report.points_added, 1u);
  EXPECT_EQ(result.cell_count(), 8u);
}

TEST(Split, FindsThePointInASmallKernel) {
  // With a long spike below, the means of its vertices and triangles lie outside of the kernel.
  Sample_cell<3> spiked = schoenhardt();
  spiked.points.push_back({0, 0, -60});
  spiked.loops.erase(spiked.loops.begin());
  spiked.loops.insert(spiked.loops.end(), {{0, 2, 6}, {2, 1, 6}, {1, 0, 6}});
  Split_report report;
  const Cell_soup<3> result = split(spiked.soup(), report);
  expect_sound(result);
  EXPECT_EQ(report.points_added, 1u);
  EXPECT_EQ(result.cell_count(), 10u);
  EXPECT_GT(result.points.back()[2], 0.0);
}

TEST(Split, RefusesWhatCannotBeCut) {
  const Sample_cell<3> hook = prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
  EXPECT_EQ(refusal(hook.soup()),
            "cell 0 cannot be split: it is not exactly convex, and no point found sees all of its facets "
            "from inside; "
            "repair or remove the cell");
  const Sample_cell<3> bow_tie = prism({{0, 0}, {2, 2}, {2, 0}, {0, 1}});
  EXPECT_NE(refusal(bow_tie.soup()).find("cell 0 cannot be split: facet 0 is a polygon that crosses"),
            std::string::npos);
  Sample_cell<3> dented = cube();
  dented.points[6] = {2, 2, 2.5};
  EXPECT_NE(refusal(dented.reversed().soup()).find("it is inverted"), std::string::npos);
  EXPECT_NE(refusal(cube().reversed().soup()).find("it is inverted"), std::string::npos);
  Sample_cell<3> open = cube();
  open.loops.pop_back();
  EXPECT_NE(refusal(open.soup()).find("one closed surface"), std::string::npos);
  EXPECT_NE(refusal(test::wound_octahedron().soup()).find("cell 0 cannot be split"), std::string::npos);
}

TEST(Split, NamesTheLowestCellItRefuses) {
  Cell_soup<3> grid = hex_grid({.cells = {4, 4, 4}});
  for (const std::uint32_t c : {50u, 37u})
    for (std::size_t f = grid.cell_begin[c]; f < grid.cell_begin[c + 1]; ++f)
      std::reverse(grid.vertices.begin() + grid.facet_begin[f],
                   grid.vertices.begin() + grid.facet_begin[f + 1]);
  EXPECT_EQ(refusal(grid).substr(0, 24), "cell 37 cannot be split:");
}

TEST(Split, RefusesMalformedInput) {
  Cell_soup<3> soup = cube().soup();
  soup.vertices[5] = 99;
  EXPECT_EQ(refusal(soup, Error_code::input), "cell 0: vertex index 99 is out of range: there are 8 points");
  soup = cube().soup();
  soup.points[3][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(soup, Error_code::input).find("cell 0: a coordinate is not a finite number"),
            std::string::npos);
  Cell_soup<2> flat;
  flat.points = {{0, 0}, {1, 0}, {0, 1}};
  add_polygon(flat, std::vector<std::uint32_t>{0, 1, 7});
  EXPECT_NE(refusal(flat, Error_code::input).find("vertex index 7"), std::string::npos);
}

TEST(Split, TriesOtherDiagonals) {
  // Strongly distorted hexahedra, so that the first choice of diagonals often leaves no star, but another
  // does.
  Random random(3);
  int split_cells = 0, needed_others = 0, refused = 0;
  for (int i = 0; i < 300; ++i) {
    Sample_cell<3> cell = cube();
    for (Point<3>& p : cell.points)
      for (double& x : p) x += random.real(-1.5, 1.5);
    // Whether any of the 64 ways to cut its facets allows an inner or outer star, asked of triangulated
    // cells.
    bool can_be_cut = false, first_can_be_cut = false;
    for (unsigned ways = 0; ways < 64; ++ways) {
      Sample_cell<3> cut{cell.points, {}};
      bool is_default = true;
      for (std::size_t f = 0; f < 6; ++f) {
        auto loop = cell.loops[f];
        const auto low = std::min_element(loop.begin(), loop.end());
        std::rotate(loop.begin(), low, loop.end());
        if (ways >> f & 1) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
        is_default = is_default && !(ways >> f & 1);
        cut.loops.push_back({loop[0], loop[1], loop[2]});
        cut.loops.push_back({loop[0], loop[2], loop[3]});
      }
      const bool possible = cut.check().defect == Cell_defect::none || refusal(cut.soup()) == "not refused";
      can_be_cut |= possible;
      first_can_be_cut |= possible && is_default;
    }
    ASSERT_EQ(refusal(cell.soup()) == "not refused", can_be_cut) << i;
    ++(can_be_cut ? split_cells : refused);
    needed_others += can_be_cut && !first_can_be_cut;
  }
  EXPECT_GT(split_cells, 100);
  EXPECT_GT(needed_others, 20);
  EXPECT_GT(refused, 10);
}

TEST(Split, TriesOtherDiagonalsBetweenTwoCells) {
  // Two distorted hexahedra side by side: the diagonal they share must suit both.
  Random random(5);
  int cut = 0, mended = 0;
  for (int i = 0; i < 400; ++i) {
    Cell_soup<3> pair = hex_grid({.cells = {2, 1, 1}});
    for (Point<3>& p : pair.points)
      for (double& x : p) x += random.real(-0.5, 0.5);
    Split_report report;
    if (refusal(pair) != "not refused") continue;
    const Cell_soup<3> result = split(pair, report);
    expect_sound(result);
    ++cut;
    // A cut that no longer starts from the lowest vertex of each facet.
    mended += report.cells_made != 12;
  }
  EXPECT_GT(cut, 100);
  EXPECT_GT(mended, 20);
}

TEST(Split, CutsStronglyJitteredGrids) {
  std::size_t other_counts = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Split_report report;
    const Cell_soup<3> result = split(jittered_grid(4, 0.48, seed, true), report);
    expect_sound(result);
    EXPECT_EQ(exact_volume(result), Rational(6 * 64));
    other_counts += report.cells_made != 6 * 64;
  }
  EXPECT_GT(other_counts, 0u);  // some diagonals were not the preferred ones
}

TEST(Split, IsTheSameForEveryOrderOfAFacetsLoop) {
  Cell_soup<3> grid = jittered_grid(3, 0.2, 5, true);
  Split_report report;
  const std::uint64_t before = test::hash(split(grid, report));
  for (std::size_t f = 0; f < grid.facet_count(); f += 2)
    std::rotate(grid.vertices.begin() + grid.facet_begin[f],
                grid.vertices.begin() + grid.facet_begin[f] + f % 4,
                grid.vertices.begin() + grid.facet_begin[f + 1]);
  EXPECT_EQ(test::hash(split(grid, report)), before);
}

TEST(Split, CutsPolygonsOfThePlane) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {2, 2}};
  add_polygon(soup, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
  add_polygon(soup, std::vector<std::uint32_t>{3, 2, 6, 4});
  soup.impassable[2] = soup.impassable[6] = 1;
  soup.solid[1] = 1;
  Split_report report;
  std::vector<std::uint32_t> origin;
  const Cell_soup<2> result = split(soup, report, &origin);
  expect_sound(result);
  EXPECT_EQ(report.cells_split, 1u);
  EXPECT_EQ(report.not_convex, 1u);
  EXPECT_EQ(report.cells_made, 4u);
  EXPECT_EQ(origin, (std::vector<std::uint32_t>{0, 0, 0, 0, 1}));
  EXPECT_EQ(exact_volume(result), Rational(2 * 4));
  EXPECT_EQ(std::count(result.impassable.begin(), result.impassable.end(), 1), 2);
  EXPECT_EQ(result.solid, (std::vector<std::uint8_t>{0, 0, 0, 0, 1}));
  EXPECT_EQ(test::count_facets(result).inner, 3u + 2u);
}

TEST(Split, CutsRandomStarShapedPolygonsOfThePlane) {
  Random random(4);
  int cut = 0;
  for (int i = 0; i < 500; ++i) {
    // On a lattice, so that vertices often lie on the line of others.
    std::vector<Point<2>> points;
    for (int k = 0; k < 9; ++k) {
      const double angle = 6.2831853 * k / 9, radius = random.real(3, 9);
      points.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle))});
    }
    const Cell_soup<2> soup = test::polygon(points).soup();
    Split_report report;
    const Cell_soup<2> result = split(soup, report);
    expect_sound(result);
    EXPECT_EQ(exact_volume(result), exact_volume(soup));
    EXPECT_EQ(result.cell_count(), report.cells_split ? 7u : 1u);
    cut += report.cells_split != 0;
  }
  EXPECT_GT(cut, 400);
}

TEST(Split, RefusesPolygonsThatCrossThemselves) {
  EXPECT_EQ(refusal(test::polygon({{0, 0}, {2, 2}, {2, 0}, {0, 1}}).soup()),
            "cell 0 cannot be split: it crosses or touches itself; repair or remove the cell");
  EXPECT_NE(refusal(test::polygon({{0, 0}, {3, 0}, {1, 0}, {0, 2}}).soup()).find("touches itself"),
            std::string::npos);
  EXPECT_NE(refusal(test::polygon({{0, 0}, {0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 0}}).soup()).find("clockwise"),
            std::string::npos);
  EXPECT_NE(refusal(test::polygon({{0, 0}, {1, 1}, {2, 2}}).soup()).find("no volume"), std::string::npos);
}

}  // namespace
}  // namespace cellwalk
