// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/build_features.h>
#include <cellwalk/internal/io/planar_file.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

const char* const poly =
    "# a square with a hole\n8 2 1 1\n1 0 0 7 1\n2 4 0 7 1\n3 4 4 7 1\n4 0 4 7 1\n5 1 1 7 2\n6 2 1 7 2\n7 2 "
    "2 7 2\n"
    "8 1 2 7 2\n8 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n5 5 6 2\n6 6 7 2\n7 7 8 2\n8 8 5 2\n1\n1 1.5 1.5\n";

using Segments = std::vector<std::array<std::uint32_t, 2>>;

TEST(Poly, IsRead) {
  Read_report report;
  const Planar_domain domain = parse_poly("t.poly", poly, &report);
  EXPECT_EQ(domain.points.size(), 8u);
  EXPECT_EQ(domain.points[6], (Point<2>{2, 2}));
  EXPECT_EQ(domain.segments, (Segments{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}));
  EXPECT_EQ(domain.holes, (std::vector<Point<2>>{{1.5, 1.5}}));
  EXPECT_EQ(report.format, "Triangle .poly");
  EXPECT_TRUE(report.notes.empty());
  parse_poly("t.poly", std::string(poly) + "1\n1 0.5 0.5 7 0.1\n", &report);
  EXPECT_EQ(report.notes, (std::vector<std::string>{"regional attributes ignored"}));
}

TEST(Poly, TakesPointsFromTheNodeFileBeside) {
  const Folder folder;
  folder.write("t.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
  const Planar_domain domain = read_poly(folder.write("t.poly", "0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n"));
  EXPECT_EQ(domain.points.size(), 3u);
  EXPECT_EQ(domain.segments, (Segments{{0, 1}, {1, 2}, {2, 0}}));
}

TEST(Poly, IsRefusedWithFileAndLine) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"8 2 1 1", "8 3 1 1",
       "t.poly:2: a .poly file of dimension 3 (TetGen's): write the surface as OFF, PLY or STL instead"},
      {"1 0 0 7 1", "2 0 0 7 1", "t.poly:3: points are numbered from 0 or 1"},
      {"3 4 4 7 1", "4 4 4 7 1", "t.poly:5: point 4 where 3 should be: points are numbered in order"},
      {"2 4 0 7 1", "2 4", "t.poly:4: a coordinate is missing"},
      {"5 5 6 2", "5 5 9 2", "t.poly:16: point 9 is out of range: there are 8, counted from 1"},
      {"5 5 6 2", "5 0 6 2", "t.poly:16: point 0 is out of range: there are 8, counted from 1"},
      {"5 5 6 2", "5 5 5 2", "t.poly:16: a segment from point 5 to itself"},
      {"1 1.5 1.5", "1 1.5", "t.poly:21: a coordinate is missing"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse_poly("t.poly", with(poly, c.from, c.to)); }), c.message);
  }
  EXPECT_EQ(refusal([] { parse_poly("t.poly", "1 2 0 0\n1 0 0\n0 0\n0\n"); }),
            "t.poly: holds no segments: there is nothing that bounds a domain");
  EXPECT_GE(refused_truncations(poly, [](const std::string& t) { parse_poly("t.poly", t); }), 18);
}

TEST(Wkt, PolygonsShareTheirPoints) {
  Read_report report;
  const Planar_domain domain = parse_wkt("t.wkt",
                                         "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)),\n ((1 0, 2 0, 2 1, 1 1, "
                                         "1 0)))\nPolygon Z((5 5 1,6 5 1,5 6 1,5 5 1))",
                                         &report);
  EXPECT_EQ(domain.points.size(), 9u);
  EXPECT_EQ(domain.segments.size(), 10u) << "the common segment once";
  EXPECT_TRUE(domain.holes.empty());
  EXPECT_EQ(report.notes,
            (std::vector<std::string>{"coordinates after x and y left out", "3 polygons with 0 holes"}));
}

TEST(Wkt, HolesHaveAPointStrictlyInside) {
  const Planar_domain square = parse_wkt(
      "t.wkt",
      "\xef\xbb\xbfPOLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1), (5 5, 7 5, 5 7, 5 5))");
  ASSERT_EQ(square.holes.size(), 2u);
  const auto [x, y] = square.holes[0];
  EXPECT_TRUE(x > 1 && x < 3 && y > 1 && y < 3);
  const auto [u, v] = square.holes[1];
  EXPECT_TRUE(u > 5 && v > 5 && u + v < 12);
}

TEST(Wkt, APointOfAHoleLiesOutsideItsIslands) {
  // A thin U-shaped hole, and a hole filled by an island but for a seam of width 1/1024.
  const Planar_domain thin = parse_wkt(
      "t.wkt",
      "POLYGON ((-1 -1, 9 -1, 9 9, -1 9, -1 -1), (0 0, 8 0, 8 8, 7.9990234375 8, 7.9990234375 0.0009765625, "
      "0.0009765625 0.0009765625, 0.0009765625 8, 0 8, 0 0))");
  ASSERT_EQ(thin.holes.size(), 1u);
  const auto [x, y] = thin.holes[0];
  EXPECT_TRUE(y > 0 && x > 0 && x < 8 && (y < 0x1p-10 || x < 0x1p-10 || x > 8 - 0x1p-10));
  const Planar_domain island = parse_wkt(
      "t.wkt",
      "MULTIPOLYGON (((-1 -1, 9 -1, 9 9, -1 9, -1 -1), (0 0, 0 8, 8 8, 8 0, 0 0)),"
      "((0.0009765625 0.0009765625, 7 0.0009765625, 7 7, 0.0009765625 7, 0.0009765625 0.0009765625)))");
  ASSERT_EQ(island.holes.size(), 1u);
  const auto [u, v] = island.holes[0];
  EXPECT_TRUE(u > 0 && v > 0 && u < 8 && v < 8);
  EXPECT_FALSE(u >= 0x1p-10 && u <= 7 && v >= 0x1p-10 && v <= 7);
}

TEST(Wkt, PartsOfAHoleCutByAnIslandEachHaveAPoint) {
  // The diamond touches the square hole in its four mid-points and leaves four corners.
  const Planar_domain domain = parse_wkt(
      "t.wkt",
      "MULTIPOLYGON (((-1 -1, 5 -1, 5 5, -1 5, -1 -1), (0 0, 2 0, 4 0, 4 2, 4 4, 2 4, 0 4, 0 2, 0 0)),"
      "((2 0, 4 2, 2 4, 0 2, 2 0)))");
  ASSERT_EQ(domain.holes.size(), 4u);
  int corners = 0;
  for (const auto& [x, y] : domain.holes) {
    EXPECT_GT(std::abs(x - 2) + std::abs(y - 2), 2);
    corners |= 1 << ((x > 2) + 2 * (y > 2));
  }
  EXPECT_EQ(corners, 15);
}

TEST(Wkt, IsRefusedWithFileAndLine) {
  struct Case {
    const char *text, *message;
  };
  const Case cases[] = {
      {"LINESTRING (0 0, 1 1)", "t.wkt:1: 'linestring' where POLYGON or MULTIPOLYGON should begin"},
      {"\nPOLYGON 0 0", "t.wkt:2: '0' where '(' should be"},
      {"POLYGON ((0 0, 1 0,\n 1 x, 0 0))", "t.wkt:2: 'x' is not a coordinate"},
      {"POLYGON ((0 0, 1 0,\n 1, 0 0))", "t.wkt:2: a coordinate is missing"},
      {"POLYGON ((0 0, 1 0,\n 1 1))", "t.wkt:2: this ring is not closed: its last point is not its first"},
      {"POLYGON ((0 0, 1 0, 0 0))", "t.wkt:1: this ring has fewer than three different points"},
      {"POLYGON ((0 0, 1 0, 1 1, 0 0)", "t.wkt:1: the text ends where ')' should be"},
      {"POLYGON EMPTY", "t.wkt: holds no polygon"},
      {"POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0),\n(1 1, 2 2, 1 1, 2 2, 1 1))",
       "t.wkt:2: no point can be found inside this hole: its ring crosses itself or another one"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    EXPECT_EQ(refusal([&] { parse_wkt("t.wkt", c.text); }), c.message);
  }
  const std::string text =
      "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1), (5 5, 7 5, 5 7, 5 5))";
  EXPECT_EQ(refused_truncations(text, [](const std::string& t) { parse_wkt("t.wkt", t); }), 20);
}

TEST(MeshFile, FlatSurfacesAreCellsOfThePlane) {
  const Folder folder;
  const Mesh_file file = read_mesh(
      folder.write("t.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n0 1 0\n4 0 1 4 5\n4 1 2 3 4\n"));
  EXPECT_EQ(kind_name(file.mesh), "planar cells");
  const auto& soup = std::get<Cell_soup<2>>(file.mesh);
  EXPECT_EQ(soup.cell_count(), 2u);
  EXPECT_EQ(soup.facet(4)[1], 2u);
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"every z is zero: the polygons are 2D cells"}));
}

TEST(MeshFile, TheContentDecidesWhereItTells) {
  const Folder folder;
  const Mesh_file domain = read_mesh(folder.write("t.off", "POLYGON ((0 0, 1 0, 0 1, 0 0))"));
  EXPECT_EQ(kind_name(domain.mesh), "planar domain");
  EXPECT_EQ(domain.report.notes.back(), "the extension says OFF, the content WKT: read by its content");
  EXPECT_EQ(kind_name(read_mesh(folder.write("t.poly", poly)).mesh), "planar domain");
  const Mesh_file surface = read_mesh(folder.write("unnamed", "OFF\n3 1 0\n0 0 1\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_EQ(kind_name(surface.mesh), "surface");
  EXPECT_TRUE(surface.report.notes.empty());
}

TEST(MeshFile, UnknownFilesAreRefusedWithWhatIsRead) {
  const Folder folder;
  const auto path = folder.write("t.xyz", "1 2 3\n");
  EXPECT_EQ(refusal([&] { read_mesh(path); }),
            path.string() +
                ": the format is not known, neither by its content nor by its extension; read are " +
                supported_formats());
  EXPECT_EQ(refusal([&] { read_mesh(folder.write("t.off", "\n \n")); }),
            (folder / "t.off").string() + ": is empty");
  EXPECT_NE(refusal([&] { read_mesh(folder / ""); }).find("is a directory without a mesh of OpenFOAM"),
            std::string::npos);
  EXPECT_NE(supported_formats().find(".ovm"), std::string::npos);
}

TEST(MeshFile, OptionalReadersArePresentOrSayHowToGetThem) {
  const Folder folder;
  ASSERT_EQ(build_features().size(), 1u);
  const Build_feature feature = build_features()[0];
  EXPECT_EQ(feature.present, !feature.version.empty());
  const std::string why = refusal([&] { read_mesh(folder.write("broken", "# vtk DataFile Version 2.0\n")); });
  EXPECT_EQ(why.find("this build lacks") == std::string::npos, feature.present) << why;
  EXPECT_EQ(supported_formats().find(feature.purpose) == std::string::npos, feature.present);
}

}  // namespace
}  // namespace cellwalk::io
