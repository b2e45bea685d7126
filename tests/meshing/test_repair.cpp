// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces with every kind of defect, whose free space is known.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/meshing/repair_surface.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "repaired.h"

namespace cellwalk {
namespace {

using test::box;
using test::cube;
using test::join;
using test::quadrangle;
using test::refusal;
using test::repair;
using test::Repaired;
using test::turned_by_angles;

/// A tube along z with a thick wall, open at both ends.
Surface_soup thick_tube(double length, int sides, double inner = 1, double outer = 1.2) {
  Surface_soup s;
  for (const double z : {0.0, length})
    for (const double r : {inner, outer})
      for (int i = 0; i < sides; ++i) {
        const double a = 2 * std::numbers::pi * i / sides;
        s.points.push_back({r * std::cos(a), r * std::sin(a), z});
      }
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    s.facets.push_back({n + i, n + j, 3 * n + j, 3 * n + i});  // outside
    s.facets.push_back({j, i, 2 * n + i, 2 * n + j});          // lumen
    s.facets.push_back({i, j, n + j, n + i});                  // low end
    s.facets.push_back({2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j});
  }
  return s;
}

struct Solids {
  const char* name;
  Surface_soup surface;
  double volume;
  std::size_t components;
  std::size_t walls;          // 0: any
  bool touch_up_to_rounding;  // turned, parts that touched do so no longer
};

std::vector<Solids> solids() {
  const Surface_soup unit = cube({0, 0, 0}, 2);
  Surface_soup hollow = join(cube({0, 0, 0}, 4), cube({1, 1, 1}, 2));
  return {
      {"that overlap", join(unit, cube({1, 1, 1}, 2)), 15, 1, 36, false},
      {"with coplanar facets", join(unit, cube({1, 0, 0}, 2)), 12, 1, 0, false},
      {"with an equal facet", join(unit, cube({2, 0, 0}, 2)), 16, 1, 20, false},
      {"with a part of a facet", join(unit, cube({2, 0.5, 0.5}, 1)), 9, 1, 0, true},
      {"with a common edge", join(unit, cube({2, 2, 0}, 2)), 16, 2, 24, false},
      {"of which three overlap", join(join(unit, cube({1, 1, 1}, 2)), cube({0, 1, 1}, 2)), 18, 1, 0, false},
      {"in the same place", join(unit, unit), 8, 1, 12, false},
      {"one within the other", hollow, 56, 1, 24, false},
  };
}

TEST(Repair, FreeSpaceOfSolids) {
  for (const Solids& s : solids()) {
    SCOPED_TRACE(s.name);
    const Repaired r = repair(s.surface);
    EXPECT_DOUBLE_EQ(r.certificate.free_volume, s.volume);
    EXPECT_EQ(r.certificate.components, s.components);
    if (s.walls != 0) {
      EXPECT_EQ(r.certificate.walls, s.walls);
    }
    EXPECT_EQ(r.certificate.membranes, 0u);
    EXPECT_EQ(r.report.moved, 0);
    EXPECT_LT(r.report.winding_error, 1e-9);
  }
}

TEST(Repair, FreeSpaceOfSolidsTurned) {
  for (const Solids& s : solids())
    for (double angle = 0.05; angle < 1.5; angle += 0.3) {
      SCOPED_TRACE(s.name + (" by " + std::to_string(angle)));
      const Repaired r = repair(turned_by_angles(s.surface, angle));
      EXPECT_NEAR(r.certificate.free_volume, s.volume, 1e-8);
      if (!s.touch_up_to_rounding) {
        EXPECT_EQ(r.certificate.components, s.components);
      }
      EXPECT_LT(r.report.moved, 1e-8);
    }
}

TEST(Repair, OrientationOfTheFileDoesNotMatter) {
  for (const Solids& s : solids()) {
    if (std::string(s.name) == "with an equal facet") continue;  // its directions say which solid it is of
    SCOPED_TRACE(s.name);
    Surface_soup mixed = test::turned(s.surface);
    for (std::size_t f = 0; f < mixed.facets.size(); f += 3)
      std::reverse(mixed.facets[f].begin(), mixed.facets[f].end());
    EXPECT_DOUBLE_EQ(repair(mixed).certificate.free_volume, s.volume);
  }
}

TEST(Repair, Hole) {
  Surface_soup open = cube({0, 0, 0}, 2);
  open.facets.pop_back();
  const Repaired r = repair(open);
  EXPECT_DOUBLE_EQ(r.certificate.free_volume, 8);
  ASSERT_EQ(r.report.parts.size(), 1u);
  const Repaired_part& cap = r.report.parts[0];
  EXPECT_EQ(cap.name, "cap_1");
  EXPECT_EQ(cap.edges, 4u);
  EXPECT_EQ(cap.facets, 2u);
  EXPECT_DOUBLE_EQ(cap.area, 4);
  EXPECT_EQ(cap.centre, (Point<3>{2, 1, 1}));
  EXPECT_EQ(cap.normal, (Vector<3>{1, 0, 0}));  // out of the free space
  EXPECT_EQ(cap.off_plane, 0);
  ASSERT_EQ(r.groups.size(), 1u);
  EXPECT_EQ(r.groups.at("cap_1").facets.size(), 2u);
}

/// The volume depends on the cap if its border is not plane: by the tetrahedron between its corners.
TEST(Repair, CapOffItsPlane) {
  Surface_soup open = cube({0, 0, 0}, 2);
  open.facets.pop_back();
  open.points[1][0] = open.points[7][0] = 3;  // two opposite corners of the hole
  const Repaired r = repair(open);
  ASSERT_EQ(r.report.parts.size(), 1u);
  EXPECT_NEAR(r.report.parts[0].off_plane, 0.5, 1e-12);
  EXPECT_NEAR(r.report.parts[0].doubt, 2.0 / 3, 1e-12);
}

TEST(Repair, CapsByArea) {
  Surface_soup open = join(box({0, 0, 0}, {1, 2, 3}), box({5, 0, 0}, {9, 2, 3}));
  open.facets.erase(open.facets.begin() + 6);  // z = 0: 4 x 2
  open.facets.erase(open.facets.begin());      // z = 0: 1 x 2
  const Repaired r = repair(open);
  ASSERT_EQ(r.report.parts.size(), 2u);
  EXPECT_DOUBLE_EQ(r.report.parts[0].area, 8);
  EXPECT_DOUBLE_EQ(r.report.parts[1].area, 2);
  EXPECT_EQ(r.report.parts[0].name, "cap_1");
  EXPECT_EQ(r.report.parts[0].normal, (Vector<3>{0, 0, -1}));
  EXPECT_EQ(r.groups.size(), 2u);
  EXPECT_DOUBLE_EQ(r.certificate.free_volume, 30);
}

struct Sheet {
  const char* name;
  Surface_soup surface;
  double area;  // of it in the box
  std::size_t components;
};

std::vector<Sheet> sheets() {
  const auto at = [](double low, double high, double y_low, double y_high) {
    return quadrangle({low, y_low, 2}, {high, y_low, 2}, {high, y_high, 2}, {low, y_high, 2});
  };
  Surface_soup both = at(1, 3, 1, 3);
  both.facets.push_back({3, 2, 1, 0});
  return {{"free", at(1, 3, 1, 3), 4, 1},
          {"across", at(0, 4, 0, 4), 16, 2},
          {"poking out", at(2, 6, 1, 3), 4, 1},
          {"hinged", at(0, 2, 1, 3), 4, 1},
          {"on both sides", both, 4, 1}};
}

TEST(Repair, SheetsAreMembranes) {
  for (const Sheet& s : sheets())
    for (const bool is_turned : {false, true}) {
      SCOPED_TRACE(std::string(s.name) + (is_turned ? ", turned" : ""));
      Surface_soup surface = join(cube({0, 0, 0}, 4), s.surface);
      if (is_turned) surface = turned_by_angles(surface);
      const Repaired r = repair(surface);
      EXPECT_NEAR(r.certificate.free_volume, 64, 1e-9);
      // Turned, a border within 1e-16 of a wall may leave a slit.
      if (!is_turned) {
        EXPECT_EQ(r.certificate.components, s.components);
      }
      EXPECT_NEAR(r.membrane_area(), s.area, 1e-6);
      EXPECT_TRUE(r.groups.contains("sheet_1"));
      EXPECT_NE(r.step("sheets").find("kept as membranes"), std::string::npos) << r.step("sheets");
    }
}

TEST(Repair, SheetsOpenedOrRefused) {
  const Surface_soup surface = join(cube({0, 0, 0}, 4), sheets()[0].surface);
  Repair_options options;
  options.sheets = Sheets::open;
  const Repaired r = repair(surface, options);
  EXPECT_EQ(r.certificate.membranes, 0u);
  EXPECT_DOUBLE_EQ(r.certificate.free_volume, 64);
  options.sheets = Sheets::refuse;
  EXPECT_NE(refusal([&] { repair(surface, options); }).find("1 sheet of 2 facets inside"), std::string::npos);
}

TEST(Repair, SeamsAreJoined) {
  // The lower half of each point of a facet of its own lies beside the upper one.
  Surface_soup s = box({0, 0, 0}, {1, 1, 1});
  for (std::size_t f = 0; f < s.facets.size(); ++f)
    for (std::uint32_t& v : s.facets[f]) {
      Point<3> p = s.points[v];
      p[f % 3] += 1e-6 * static_cast<double>(f);
      s.points.push_back(p);
      v = static_cast<std::uint32_t>(s.points.size() - 1);
    }
  const Repaired r = repair(s);
  EXPECT_NEAR(r.certificate.free_volume, 1, 1e-4);
  EXPECT_EQ(r.certificate.vertices, 8u);
  EXPECT_NE(r.step("seams").find("16 points of seams joined"), std::string::npos) << r.step("seams");
  EXPECT_LE(r.report.moved, 1e-5);
  EXPECT_TRUE(r.report.parts.empty());
}

TEST(Repair, NearPoints) {
  for (int exponent = 3; exponent <= 20; ++exponent) {
    SCOPED_TRACE(exponent);
    Surface_soup s = cube({0, 0, 0}, 1);
    const double d = std::pow(10.0, -exponent);
    s.points.push_back({d, 0.25 * d, 0.125 * d});  // a corner of a dent in the first facet
    s.facets[0] = {0, 2, 8};
    s.facets.push_back({2, 3, 8}), s.facets.push_back({3, 1, 8}), s.facets.push_back({1, 0, 8});
    const Repaired r = repair(s);
    EXPECT_NEAR(r.certificate.free_volume, 1, 1e-3);
  }
}

TEST(Repair, ThickWallHasALumen) {
  const int sides = 24;
  const Surface_soup tube = thick_tube(12, sides);
  const double base = sides * std::sin(2 * std::numbers::pi / sides) / 2;  // of a polygon of radius 1
  const Repaired lumen = repair(tube);
  EXPECT_NE(lumen.step("lumen").find("thick wall"), std::string::npos);
  EXPECT_NEAR(lumen.certificate.free_volume, 12 * base, 0.02 * 12 * base);
  EXPECT_TRUE(lumen.groups.contains("mouth_1"));
  EXPECT_TRUE(lumen.groups.contains("mouth_2"));
  EXPECT_FALSE(lumen.groups.contains("mouth_3"));
  for (const Repaired_part& mouth : lumen.report.parts) {
    EXPECT_NEAR(mouth.area, base, 0.2 * base);
    EXPECT_GT(std::abs(mouth.normal[2]), 0.9);
    EXPECT_EQ(mouth.normal[2] > 0, mouth.centre[2] > 6);  // out of the lumen
  }
  EXPECT_LT(lumen.report.moved, 1e-9);

  Repair_options options;
  options.is_solid = true;
  EXPECT_NEAR(repair(tube, options).certificate.free_volume, 12 * 0.44 * base, 1e-9);
  options.is_solid = false;
  options.inside = {{0, 0, 6}};
  EXPECT_NEAR(repair(tube, options).certificate.free_volume, 12 * base, 0.02 * 12 * base);
  options.inside = {{1.1, 0, 6}};  // in the material
  EXPECT_NEAR(repair(tube, options).certificate.free_volume, 12 * 0.44 * base, 1e-9);
  options.inside = {{3, 0, 6}};
  EXPECT_NE(refusal([&] { repair(tube, options); }).find("narrower than the box"), std::string::npos);
}

/// Walls of four layers that touch, exactly or but for rounding: from either side of a layer, a ray meets the
/// next one at once.
TEST(Repair, ThickWallOfLayers) {
  const int sides = 24;
  const double base = sides * std::sin(2 * std::numbers::pi / sides) / 2;
  for (const double rounding : {0.0, 2e-16, -2e-16}) {
    SCOPED_TRACE(rounding);
    Surface_soup tube;
    double inner = 1;
    for (const double outer : {1.1, 1.2, 1.3, 1.4}) {
      tube = join(tube, thick_tube(12, sides, inner, outer));
      inner = outer + rounding;
    }
    const Repaired lumen = repair(tube);
    EXPECT_NE(lumen.step("lumen").find("thick wall"), std::string::npos);
    EXPECT_NEAR(lumen.certificate.free_volume, 12 * base, 1e-9);
  }
}

/// A part on a wall, but for rounding, is a part or a hollow as the directions of its facets say.
TEST(Repair, PartsThatNearlyTouch) {
  for (const double gap : {1e-12, 1e-14}) {
    SCOPED_TRACE(gap);
    const Surface_soup inner = box({1, 1, gap}, {3, 3, 2});
    EXPECT_NEAR(repair(join(cube({0, 0, 0}, 4), inner)).certificate.free_volume, 64, 1e-9);
    EXPECT_NEAR(repair(join(cube({0, 0, 0}, 4), test::turned(inner))).certificate.free_volume, 56, 1e-9);
  }
  // Farther from it, it is a hollow.
  EXPECT_NEAR(repair(join(cube({0, 0, 0}, 4), box({1, 1, 1e-9}, {3, 3, 2}))).certificate.free_volume, 56,
              1e-6);
}

/// A prism that crosses itself: one of its halves has its facets inside out, whichever way all are turned.
TEST(Repair, InsideOut) {
  Surface_soup bow;
  for (const double z : {0.0, 2.0})
    for (const Point<2>& p : {Point<2>{0, 0}, {6, 3}, {6, 0}, {0, 1}}) bow.points.push_back({p[0], p[1], z});
  for (std::uint32_t i = 0; i < 4; ++i) bow.facets.push_back({i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i});
  for (const auto& facet : {std::vector<std::uint32_t>{4, 5, 6}, {4, 6, 7}, {2, 1, 0}, {3, 2, 0}})
    bow.facets.push_back(facet);
  const Repaired r = repair(bow);
  EXPECT_NEAR(r.certificate.free_volume, 13.5, 1e-9);
  EXPECT_NE(r.step("inside_out").find("a volume of 1.5 is not free"), std::string::npos)
      << r.step("inside_out");
}

/// Volumes that are smaller than the rounding of their facets.
TEST(Repair, ThinSlabs) {
  for (const double thick : {1e-9, 1e-12}) {
    const Repaired r = repair(turned_by_angles(box({0, 0, 0}, {1, 1, thick})));
    EXPECT_NEAR(r.certificate.free_volume, thick, 1e-4 * thick);
  }
}

/// Facets in one plane are cut together: turned, where rounding parts their planes, few more pieces are made.
TEST(Repair, FacetsInAPlane) {
  Surface_soup star;
  for (int k = 0; k < 5; ++k) {
    Surface_soup part = cube({-1, -1, 0}, 2);
    for (Point<3>& p : part.points)
      p = {std::cos(0.31 * k) * p[0] - std::sin(0.31 * k) * p[1],
           std::sin(0.31 * k) * p[0] + std::cos(0.31 * k) * p[1], p[2]};
    star = join(star, part);
  }
  const Repaired r = repair(star), turned = repair(turned_by_angles(star, 0.3));
  EXPECT_NEAR(turned.certificate.free_volume, r.certificate.free_volume, 1e-9);
  EXPECT_LT(turned.certificate.walls, 1.5 * static_cast<double>(r.certificate.walls));
}

TEST(Repair, NothingEnclosed) {
  const Surface_soup plane = quadrangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_NE(refusal([&] { repair(plane); }).find("encloses nothing"), std::string::npos);
  EXPECT_NE(refusal([&] { repair({}); }).find("is empty"), std::string::npos);
  Surface_soup broken = cube({0, 0, 0}, 1);
  broken.facets[2][1] = 77;
  EXPECT_NE(refusal([&] { repair(broken); }).find("facet 2 names vertex 77"), std::string::npos);
  broken = cube({0, 0, 0}, 1);
  broken.points[3][1] = std::nan("");
  EXPECT_NE(refusal([&] { repair(broken); }).find("not finite: vertex 3"), std::string::npos);
}

TEST(Repair, SameInputSameCells) {
  const Surface_soup surface = turned_by_angles(join(cube({0, 0, 0}, 2), cube({1, 1, 1}, 2)));
  const Repaired one = repair(surface), other = repair(surface);
  EXPECT_EQ(one.soup.points, other.soup.points);
  EXPECT_EQ(one.soup.vertices, other.soup.vertices);
}

TEST(Repair, BoundsOfQualityKeepTheWalls) {
  Surface_soup surface = test::octahedron(3);
  surface.facets.erase(surface.facets.begin() + 7);
  Tetrahedralize_options coarse, fine;
  coarse.quality = 0;
  fine.cell_size = 0.1;
  const Repaired one = repair(surface, {}, coarse), other = repair(surface, {}, fine);
  EXPECT_EQ(one.certificate.walls, 512u);
  EXPECT_EQ(other.certificate.walls, 512u);
  EXPECT_EQ(one.groups.at("cap_1").facets.size(), 1u);
  EXPECT_EQ(other.groups.at("cap_1").facets.size(), 1u);
  EXPECT_GT(other.certificate.cells, 2 * one.certificate.cells);
  EXPECT_GT(other.report.added_points, one.report.added_points);
}

TEST(Repair, AnySize) {
  for (const double size : {1e-200, 1e-100, 1e-60, 1e-30, 1e-3, 1e3, 1e30, 1e60, 1e100, 1e200}) {
    SCOPED_TRACE(size);
    Surface_soup surface = cube({0, 0, 0}, size);
    surface.facets.pop_back();
    Repair_report report;
    const Repaired_surface repaired = repair_surface(surface, {}, {}, report);
    EXPECT_NEAR(report.parts.at(0).width / size, 2 / std::sqrt(std::numbers::pi), 1e-9);
    for (const Point<3>& p : repaired.soup.points)
      for (const double x : p) EXPECT_TRUE(x == 0 || x == size) << x;
  }
}

TEST(Repair, OptionsOutOfRange) {
  Repair_options options;
  options.seam = -1;
  EXPECT_NE(refusal([&] { repair(cube({0, 0, 0}, 1), options); }).find("--seam"), std::string::npos);
}

}  // namespace
}  // namespace cellwalk
