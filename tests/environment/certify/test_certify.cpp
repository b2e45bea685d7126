// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/certify.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/environment/split.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "environment/cell_samples.h"
#include "environment/certify_samples.h"
#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

using test::append;
using test::certificate_of;
using test::cube;
using test::moved;
using test::prism;
using test::refusal_of;
using test::Sample_cell;
using test::tetrahedron;
using test::tetrahedron_of;

TEST(Certify, CountsAGrid) {
  const Certificate c = certificate_of(hex_grid({.cells = {3, 4, 5}}));
  EXPECT_EQ(c.cells, 60u);
  EXPECT_EQ(c.facets, 4u * 4 * 5 + 3 * 5 * 5 + 3 * 4 * 6);
  EXPECT_EQ(c.ridges, 3u * 5 * 6 + 4 * 4 * 6 + 4 * 5 * 5);
  EXPECT_EQ(c.vertices, 4u * 5 * 6);
  EXPECT_EQ(c.boundary_facets, 2u * (12 + 15 + 20));
  EXPECT_EQ(c.walls, c.boundary_facets);
  EXPECT_EQ(c.membranes, 0u);
  EXPECT_EQ(c.components, 1u);
  EXPECT_EQ(c.solid_cells, 0u);
  EXPECT_EQ(c.pinched_vertices, 0u);
  EXPECT_EQ(c.volume, 60);
  EXPECT_EQ(c.free_volume, 60);
}

TEST(Certify, CountsAGridOfThePlane) {
  const Certificate c = certificate_of(square_grid({.cells = {3, 4}}));
  EXPECT_EQ(c.cells, 12u);
  EXPECT_EQ(c.facets, 3u * 5 + 4 * 4);
  EXPECT_EQ(c.ridges, 20u);
  EXPECT_EQ(c.vertices, 20u);
  EXPECT_EQ(c.boundary_facets, 14u);
  EXPECT_EQ(c.volume, 12);
}

TEST(Certify, CountsSolidCellsAndMembranes) {
  Cell_soup<3> soup = hex_grid({.cells = {3, 3, 3}, .solid_cells = {13}});
  // The lowest layer is walled off from the rest by nine two-sided walls.
  for (std::size_t c = 0; c < 9; ++c) soup.impassable[6 * c + 1] = 1;
  const Certificate c = certificate_of(soup);
  EXPECT_EQ(c.solid_cells, 1u);
  EXPECT_EQ(c.membranes, 8u);  // the ninth is a wall of the solid cell
  EXPECT_EQ(c.walls, 54u + 8 + 6);
  EXPECT_EQ(c.components, 2u);
  EXPECT_EQ(c.volume, 27);
  EXPECT_EQ(c.free_volume, 26);
}

TEST(Certify, CountsPinchedVerticesAndEdges) {
  Cell_soup<3> corner = cube().soup();
  append(corner, moved(cube(), {2, 2, 2}).soup(), true);
  Certificate c = certificate_of(corner);
  EXPECT_EQ(c.vertices, 15u);
  EXPECT_EQ(c.pinched_vertices, 1u);
  EXPECT_EQ(c.ridges, 24u);
  EXPECT_EQ(c.components, 2u);
  Cell_soup<3> edge = cube().soup();
  append(edge, moved(cube(), {2, 2, 0}).soup(), true);
  c = certificate_of(edge);
  EXPECT_EQ(c.vertices, 14u);
  EXPECT_EQ(c.pinched_vertices, 2u);
  EXPECT_EQ(c.ridges, 24u);  // the common edge has two fans
  Cell_soup<2> squares = test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).soup();
  append(squares, test::polygon({{1, 1}, {2, 1}, {2, 2}, {1, 2}}).soup(), true);
  const Certificate flat = certificate_of(squares);
  EXPECT_EQ(flat.vertices, 7u);
  EXPECT_EQ(flat.ridges, 8u);
  EXPECT_EQ(flat.pinched_vertices, 1u);
}

TEST(Certify, AcceptsCoplanarFacetsAndCollinearVertices) {
  // Prisms over an L of three polygons, one of which has a vertex inside a side.
  Cell_soup<3> soup = prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}).soup();
  append(soup, prism({{0, 1}, {1, 1}, {1, 2}, {0, 2}}).soup(), true);
  append(soup, prism({{1, 1}, {2, 1}, {2, 2}, {1, 2}}).soup(), true);
  const Certificate c = certificate_of(soup);
  EXPECT_EQ(c.cells, 3u);
  EXPECT_EQ(c.facets, 7u + 6 + 6 - 3);
  EXPECT_EQ(c.volume, 4);
  EXPECT_EQ(c.components, 1u);
}

TEST(Certify, AcceptsEveryLatticeWorld) {
  std::size_t membranes = 0, pinched = 0, solid = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Cell_soup<3> soup = lattice_world(mixed_lattice_world<3>(seed));
    const Certificate c = certificate_of(soup);
    const test::Facet_counts facets = test::count_facets(soup);
    EXPECT_EQ(c.facets, facets.inner + facets.boundary);
    EXPECT_EQ(c.boundary_facets, facets.boundary);
    EXPECT_DOUBLE_EQ(c.volume, test::volume(soup));
    const Cell_soup<2> flat = lattice_world(mixed_lattice_world<2>(seed));
    const Certificate d = certificate_of(flat);
    EXPECT_EQ(d.facets, test::count_facets(flat).inner + test::count_facets(flat).boundary);
    EXPECT_DOUBLE_EQ(d.volume, test::volume(flat));
    membranes += c.membranes > 0 && d.membranes > 0;
    pinched += c.pinched_vertices > 0 && d.pinched_vertices > 0;
    solid += c.solid_cells > 0 && d.solid_cells > 0;
  }
  EXPECT_GT(membranes, 20u);
  EXPECT_GT(pinched, 10u);
  EXPECT_GT(solid, 20u);
}

TEST(Certify, AcceptsASplitGrid) {
  Cell_soup<3> soup = hex_grid({.cells = {5, 5, 5}});
  Random random(1);
  for (Point<3>& p : soup.points)
    for (double& x : p) x += random.real(-0.2, 0.2);
  Split_report report;
  const Certificate c = certificate_of(split(soup, report));
  EXPECT_EQ(c.cells, report.cells_made);
  EXPECT_EQ(c.boundary_facets, 2u * 6 * 25);
  EXPECT_EQ(c.vertices, 216u + report.points_added);
  EXPECT_EQ(c.components, 1u);
}

TEST(Certify, NamesTheLowestBadCell) {
  Cell_soup<3> soup = hex_grid({.cells = {4, 4, 4}});
  for (Point<3>& p : soup.points)
    if (p == Point<3>{2, 2, 3} || p == Point<3>{3, 3, 4}) p[0] += 0x1p-40;
  const std::string message = refusal_of(soup);
  EXPECT_EQ(message.substr(0, 9), "cell 37: ") << message;  // (1,1,2), the first one at (2,2,3)
  EXPECT_NE(message.find("is not exactly planar; split or repair the cell"), std::string::npos) << message;
  tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(refusal_of(soup), message);
}

TEST(Certify, RefusesSolidCellsOpenToFreeSpace) {
  Cell_soup<3> soup = hex_grid({.cells = {2, 1, 1}});
  soup.solid[1] = 1;
  EXPECT_EQ(refusal_of(soup),
            "facet (1 4 10 7) of cell 0 is passable between a solid cell and a free one: mark it impassable");
  soup.impassable[3] = 1;
  EXPECT_EQ(certificate_of(soup).free_volume, 1);
  Cell_soup<2> flat = square_grid({.cells = {2, 1}});
  flat.solid[0] = 1;
  EXPECT_EQ(refusal_of(flat),
            "facet (1 4) of cell 0 is passable between a solid cell and a free one: mark it impassable");
}

TEST(Certify, RefusesFalseGluings) {
  const Cell_soup<3> soup = hex_grid({.cells = {3, 1, 1}});
  Gluing gluing = glue(soup);
  // Facets 3 of cell 0 and 5 of cell 2 do not meet.
  gluing.opposite[3] = 12 + 5;
  gluing.opposite[12 + 5] = 3;
  gluing.opposite[6 + 5] = gluing.opposite[6 + 3] = no_facet;
  EXPECT_EQ(refusal_of(soup, gluing),
            "facet (1 5 13 9) of cell 0 is glued to a facet with other vertices: glue the cells again");
  // Facet 5 of cell 0 and facet 3 of cell 1 do not meet, but two other facets of these cells do.
  const Cell_soup<3> two = hex_grid({.cells = {2, 1, 1}});
  Gluing of_two = glue(two);
  of_two.opposite[5] = 6 + 3;
  of_two.opposite[6 + 3] = 5;
  EXPECT_EQ(refusal_of(two, of_two),
            "facet (3 0 6 9) of cell 0 does not occur in the cell it is glued to: glue the cells again");
}

TEST(Certify, RefusesDuplicateVerticesUnlessAllowed) {
  Cell_soup<3> soup = cube().soup();
  append(soup, moved(cube(), {2, 0, 0}).soup(), false);
  EXPECT_EQ(refusal_of(soup),
            "vertices 1 (of cell 0) and 8 (of cell 1) lie in the same place (2, 0, 0): merge "
            "them, or keep duplicate vertices");
  const Certificate c = certificate_of(soup, true);
  EXPECT_EQ(c.components, 2u);
  EXPECT_EQ(c.vertices, 16u);
  EXPECT_EQ(c.pinched_vertices, 0u);
  // Points that no cell uses do not count.
  Cell_soup<3> unused = cube().soup();
  unused.points.push_back(unused.points[0]);
  EXPECT_EQ(certificate_of(unused).vertices, 8u);
}

TEST(Certify, RefusesCellsThatTurnTwiceRoundARidge) {
  const Cell_soup<2> once = test::ring(5, 5, true);
  EXPECT_EQ(certificate_of(once).boundary_facets, 5u);
  const std::string message = refusal_of(test::ring(10, 5, true));
  EXPECT_EQ(message,
            "facet (0 1) of cell 0: the 10 cells round vertex 0 turn round it more than once, so that they "
            "overlap: "
            "repair the mesh");
  EXPECT_EQ(certificate_of(test::prisms(once)).cells, 5u);
  const std::string edge = refusal_of(test::prisms(test::ring(10, 5, true)));
  EXPECT_NE(edge.find("facet (2 0 11 13) of cell 0: the 10 cells round the edge of vertices 0 and 11 turn"),
            std::string::npos)
      << edge;
}

TEST(Certify, RefusesBoundaryFansThatTurnMoreThanOnce) {
  for (const int cells : {2, 4, 5}) {
    // Five cells turn exactly once: the first and the last facet lie on each other, without being glued.
    EXPECT_EQ(certificate_of(test::ring(cells, 5, false)).cells, static_cast<std::size_t>(cells));
    EXPECT_EQ(certificate_of(test::prisms(test::ring(cells, 5, false))).cells,
              static_cast<std::size_t>(cells));
  }
  for (const int cells : {6, 7, 9}) {
    EXPECT_NE(refusal_of(test::ring(cells, 5, false)).find("turn round it more than once"),
              std::string::npos);
    EXPECT_NE(refusal_of(test::prisms(test::ring(cells, 5, false))).find("turn round it more than once"),
              std::string::npos);
  }
  // A full turn, and then next to nothing.
  Cell_soup<2> soup = test::ring(5, 5, false);
  soup.points.back() = {soup.points.back()[0], std::nextafter(0.0, 1.0)};
  EXPECT_NE(refusal_of(soup).find("the 5 cells round vertex 0 turn round it more than once"),
            std::string::npos);
}

TEST(Certify, RefusesOverlappingComponents) {
  for (const Point<3>& shift :
       {Point<3>{1, 1, 1}, {1, 0.5, 0}, {0, 0, 1.5}, {0x1p-50, 0, 0}, {1.875, 1.875, -1.875}}) {
    Cell_soup<3> soup = cube().soup();
    append(soup, moved(cube(), shift).soup(), false);
    const std::string message = refusal_of(soup, true);
    EXPECT_NE(message.find("cells overlap; repair the mesh"), std::string::npos) << message;
    EXPECT_NE(message.find(" of cell 1 lies on the boundary, but cell 0 reaches across it"),
              std::string::npos)
        << message;
  }
}

TEST(Certify, RefusesNestedComponents) {
  Cell_soup<3> soup = hex_grid({.cells = {4, 4, 4}});
  append(soup, moved(tetrahedron(), {1.25, 1.25, 1.25}).soup(), false);  // across inner facets only
  EXPECT_NE(refusal_of(soup).find(" of cell 64 lies on the boundary, but cell 21 reaches across it"),
            std::string::npos);
  Cell_soup<2> flat = square_grid({.cells = {3, 3}});
  append(flat, test::polygon({{1.25, 1.25}, {1.75, 1.25}, {1.5, 1.75}}).soup(), false);
  EXPECT_NE(
      refusal_of(flat).find("facet (16 17) of cell 9 lies on the boundary, but cell 4 reaches across it"),
      std::string::npos);
}

TEST(Certify, RefusesCellsInTheSamePlace) {
  // The same cube twice, its facets cut differently: nothing is glued, and no facet enters the interior of a
  // cell.
  Sample_cell<3> cut{cube().points, {}};
  for (const auto& loop : cube().loops) {
    cut.loops.push_back({loop[0], loop[1], loop[2]});
    cut.loops.push_back({loop[0], loop[2], loop[3]});
  }
  Cell_soup<3> soup = cube().soup();
  append(soup, cut.soup(), true);
  EXPECT_NE(refusal_of(soup).find("cells overlap"), std::string::npos);
  // A square, and the same one of two triangles.
  Cell_soup<2> flat = test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).soup();
  append(flat, moved(test::polygon({{0, 0}, {1, 0}, {1, 1}}), {0, 0}).soup(), false);
  EXPECT_NE(refusal_of(flat, true).find("cells overlap"), std::string::npos);
}

TEST(Certify, AcceptsComponentsThatTouch) {
  // Face to face, edge to edge, a corner on a face, an edge along a face.
  for (const Point<3>& shift : {Point<3>{2, 0, 0}, {2, 1, 0.5}, {2, 2, 1}, {2, 2, 2}, {-2, 1, -2}}) {
    Cell_soup<3> soup = cube().soup();
    append(soup, moved(cube(), shift).soup(), false);
    EXPECT_EQ(certificate_of(soup, true).components, 2u);
  }
  Cell_soup<3> corner = cube().soup();
  append(corner, moved(tetrahedron(), {1, 1, 2}).soup(), false);
  append(corner, tetrahedron_of({1, 1, 0}, {0.5, 0, -1}, {2, 0.5, -1}, {1, 3, -2}).soup(), false);
  EXPECT_EQ(certificate_of(corner).components, 3u);
  // Two edges that cross in one point: only a plane through both parts their cells.
  Cell_soup<3> crossed = tetrahedron_of({-2, -2, 0}, {2, 2, 0}, {-1, 1, -3}, {1, -1, -5}).soup();
  append(crossed, tetrahedron_of({-2, 2, 0}, {2, -2, 0}, {1, 1, 3}, {-1, -1, 5}).soup(), false);
  EXPECT_EQ(certificate_of(crossed).components, 2u);
  for (std::size_t i = 0; i < 4; ++i) crossed.points[i][2] += 0x1p-40;
  EXPECT_NE(refusal_of(crossed).find("cells overlap"), std::string::npos);
}

TEST(Certify, AgreesWithBruteForceOnPairsOfTetrahedra) {
  Random random(11);
  int apart = 0, overlapping = 0, box_overlaps = 0;
  for (int i = 0; i < 1000; ++i) {
    Cell_soup<3> soup;
    for (int k = 0; k < 2; ++k) {
      Sample_cell<3> cell = tetrahedron();
      do {
        for (Point<3>& p : cell.points)
          for (double& x : p) x = static_cast<double>(random.below(4) + k);
      } while (cell.check().defect != Cell_defect::none);
      append(soup, cell.soup(), false);
    }
    const bool overlap = test::interiors_meet(soup, 0, 1);
    const std::string message = test::refusal_or_none(soup, true);
    ASSERT_EQ(message.find("cells overlap") != std::string::npos, overlap)
        << "in round " << i << ": " << message;
    ASSERT_EQ(message.empty(), !overlap) << message;
    ++(overlap ? overlapping : apart);
    box_overlaps += !overlap && test::boxes_meet(soup, 0, 1);
  }
  EXPECT_GT(overlapping, 200);
  EXPECT_GT(apart, 200);
  EXPECT_GT(box_overlaps, 100);
}

TEST(Certify, AgreesWithBruteForceOnPairsOfTriangles) {
  Random random(12);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 1000; ++i) {
    Cell_soup<2> soup;
    for (int k = 0; k < 2; ++k) {
      Sample_cell<2> cell;
      do {
        std::vector<Point<2>> points(3);
        for (Point<2>& p : points)
          for (double& x : p) x = static_cast<double>(random.below(4) + k);
        cell = test::polygon(points);
      } while (cell.check().defect != Cell_defect::none);
      append(soup, cell.soup(), false);
    }
    const bool overlap = test::interiors_meet(soup, 0, 1);
    ASSERT_EQ(!test::refusal_or_none(soup, true).empty(), overlap) << "in round " << i;
    ++(overlap ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 200);
  EXPECT_GT(apart, 200);
}

}  // namespace
}  // namespace cellwalk
