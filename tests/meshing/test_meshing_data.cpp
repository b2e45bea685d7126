// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces of public origin: clean ones are meshed, bad ones are refused for the reason they are bad.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <gtest/gtest.h>

#include "environment/soup_checks.h"
#include "meshing/shapes.h"

namespace cellwalk {
namespace {

using test::refusal;

/// Reads a surface apart from the library's own readers.
Surface_soup read(const std::string& file) {
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(CELLWALK_TEST_DATA "/" + file, points, polygons))
    throw Error(Error_code::input, "cannot read " + file);
  Surface_soup s;
  for (const auto& p : points) s.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& f : polygons) s.facets.emplace_back(f.begin(), f.end());
  return s;
}

std::string why(const std::string& file) {
  const auto surface = read(file);
  return refusal([&] { check_surface(surface); });
}

class CleanSurface : public testing::TestWithParam<const char*> {};

TEST_P(CleanSurface, IsFilledWithItsBoundaryKept) {
  const auto surface = read(std::string("surface/") + GetParam());
  Tetrahedralize_report report;
  const auto soup = tetrahedralize(surface, {}, {}, &report);
  // The liver comes with vertices of no facet.
  EXPECT_EQ(describe(report.surface).size(), report.surface.unused_points > 0 ? 1u : 0u);
  Predicate_counts counts;
  std::size_t walls = 0;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const auto v = soup.facet(soup.cell_begin[c]), w = soup.facet(soup.cell_begin[c] + 1);
    const auto at = [&soup](std::uint32_t i) { return soup.points[i]; };
    ASSERT_EQ(Lazy::orientation(counts, at(v[0]), at(v[2]), at(v[1]), at(w[2])), 1) << "cell " << c;
    for (auto f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) walls += soup.impassable[f];
  }
  EXPECT_EQ(walls, surface.facets.size());
  EXPECT_EQ(report.boundary_facets, surface.facets.size());
  EXPECT_EQ(test::count_facets(soup).boundary, surface.facets.size());
  EXPECT_EQ(test::count_facets(soup).crowded, 0u);
  EXPECT_EQ(soup.points.size(), surface.points.size() - report.surface.unused_points + report.added_points);
  EXPECT_NEAR(test::volume(soup), report.surface.volume, 1e-9 * report.surface.volume);
  Build_options options;
  options.split = false;
  Build_report built;
  Environment<3>::build(soup, options, &built);
  EXPECT_EQ(built.certificate.boundary_facets, surface.facets.size());
}

INSTANTIATE_TEST_SUITE_P(Files, CleanSurface,
                         testing::Values("aneurysm3D_1.off", "eight.off", "elephant.off", "femur.off",
                                         "joint.off", "knot2.off", "sofa_liver.obj"),
                         [](const auto& file) {
                           std::string name = file.param;
                           name.erase(name.find('.'));
                           return name;
                         });

TEST(CleanSurfaces, AreApproximatedByMesh3) {
  Mesh3_report report;
  const auto surface = read("surface/elephant.off");
  const auto soup = mesh3(surface, {}, {}, &report);
  EXPECT_GT(soup.cell_count(), 1000u);
  EXPECT_EQ(test::count_facets(soup).boundary, report.boundary_facets);
  EXPECT_GT(report.distance_to_surface, 0);
  EXPECT_LT(report.distance_to_surface, 0.02);  // of an elephant 1 long
  EXPECT_LT(report.distance_from_surface, 0.05);
  EXPECT_NO_THROW(Environment<3>::build(soup));
}

TEST(BadSurfaces, InsideOutIsTurned) {
  Surface_report report;
  check_surface(read("bad/aneurysm3d_collis_inward.obj"), "surface", &report);
  EXPECT_TRUE(report.inside_out);
  EXPECT_NEAR(report.volume, 65.04, 0.01);
}

TEST(BadSurfaces, ShuffledOrientationIsRepaired) {
  for (const char* file : {"bad/blobby-shuffled.off", "bad/tet-shuffled.off"}) {
    Surface_report report;
    check_surface(read(file), "surface", &report);
    EXPECT_GT(report.turned_facets, 0u) << file;
    EXPECT_GT(report.volume, 0) << file;
  }
}

TEST(BadSurfaces, AreRefusedForTheirReason) {
  EXPECT_EQ(
      why("bad/cube-ouvert.off"),
      "3: surface is open: 4 boundary edges, the first between vertices 1 and 2; close its holes so that it "
      "bounds a volume");
  EXPECT_EQ(why("bad/diplodocus.off"),
            "3: surface is not manifold: more than two facets meet at 2 edges, the first between vertices "
            "15404 and "
            "15545; separate the sheets that meet there");
  // Two of its vertices lie in one place; and it intersects itself elsewhere.
  EXPECT_EQ(why("bad/cow.off"),
            "3: surface is not manifold: separate sheets meet at 1 vertex, the first vertex 44; pull the "
            "sheets apart "
            "there");
}

}  // namespace
}  // namespace cellwalk
