// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

const char* const two_tetrahedra = R"(OVM ASCII
Vertices
5
0 0 0
1 0 0
0 1 0
0 0 1
0 0 -1
Edges
9
0 1
1 2
2 0
0 3
1 3
2 3
0 4
1 4
2 4
Faces
7
3 0 2 4
3 0 8 7
3 2 10 9
3 4 6 11
3 0 14 13
3 2 16 15
3 4 12 17
Polyhedra
2
4 1 2 4 6
4 0 9 11 13
FProp bool "impassable"
1
0
0
0
0
0
0
CProp bool "solid"
0
1
VProp float "weight"
1
2
3
4
5
)";

Cell_soup<3> read_3(const std::string& text) { return std::get<Cell_soup<3>>(parse_ovm("t.ovm", text).mesh); }

/// A loop turned so that its lowest vertex comes first.
std::vector<std::uint32_t> turned(std::span<const std::uint32_t> loop) {
  std::vector<std::uint32_t> v(loop.begin(), loop.end());
  std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
  return v;
}

template <int D>
void expect_same(const Cell_soup<D>& a, const Cell_soup<D>& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (int k = 0; k < D; ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.points[i][k]), std::bit_cast<std::uint64_t>(b.points[i][k]));
  ASSERT_EQ(a.cell_begin, b.cell_begin);
  ASSERT_EQ(a.facet_begin, b.facet_begin);
  for (std::size_t f = 0; f < a.facet_count(); ++f) {
    if (D == 3)
      EXPECT_EQ(turned(a.facet(f)), turned(b.facet(f)));
    else
      EXPECT_TRUE(std::ranges::equal(a.facet(f), b.facet(f)));
  }
  EXPECT_EQ(a.impassable, b.impassable);
  EXPECT_EQ(a.solid, b.solid);
}

template <int D>
Cell_soup<D> rewritten(const Cell_soup<D>& soup) {
  const Folder folder;
  write_ovm(folder / "a.ovm", soup);
  Cell_soup<D> read = std::get<Cell_soup<D>>(read_ovm(folder / "a.ovm").mesh);
  write_ovm(folder / "b.ovm", read);
  EXPECT_EQ(content_of(folder / "a.ovm"), content_of(folder / "b.ovm"));
  return read;
}

/// Numbers that lose their last bits, or their sign, in a careless writer.
std::vector<double> nasty_numbers() {
  using limits = std::numeric_limits<double>;
  std::vector<double> v{-0.0,
                        0.0,
                        limits::denorm_min(),
                        -limits::denorm_min(),
                        limits::min(),
                        limits::max(),
                        -limits::max(),
                        limits::epsilon(),
                        0x1.fffffffffffffp-1,
                        0x1.0000000000001p+0,
                        0.1,
                        1.0 / 3,
                        5e-324,
                        2.2250738585072011e-308,
                        1e23};
  std::mt19937_64 random(7);
  while (v.size() < 300) {
    const double x = std::bit_cast<double>(random());
    if (std::isfinite(x)) v.push_back(x);
  }
  return v;
}

TEST(Ovm, ReadsCellsWallsAndSolidCells) {
  const Mesh_file file = parse_ovm("t.ovm", two_tetrahedra);
  const auto& soup = std::get<Cell_soup<3>>(file.mesh);
  ASSERT_EQ(soup.cell_count(), 2u);
  ASSERT_EQ(soup.facet_count(), 8u);
  EXPECT_TRUE(
      std::ranges::equal(soup.facet(0), std::vector<std::uint32_t>{2, 1, 0}));  // halfface 1: against face 0
  EXPECT_TRUE(std::ranges::equal(soup.facet(1), std::vector<std::uint32_t>{0, 1, 3}));
  EXPECT_TRUE(std::ranges::equal(soup.facet(4), std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(soup.impassable, (std::vector<std::uint8_t>{1, 0, 0, 0, 1, 0, 0, 0}))
      << "a wall is one from both sides";
  EXPECT_EQ(soup.solid, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"property VProp \"weight\" ignored"}));
  EXPECT_EQ(file.report.points, 5u);
  EXPECT_EQ(file.report.cells, 2u);
}

TEST(Ovm, IsReadWithOtherCaseBlanksAndLineEnds) {
  std::string text = with(with(two_tetrahedra, "Vertices\n5", "VERTICES 5"), "FProp bool", "fprop Bool");
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 3) text.replace(i, 1, "\t\r\n");
  expect_same(read_3(text), read_3(two_tetrahedra));
}

TEST(Ovm, KeepsEveryBitOfCoordinates) {
  Cell_soup<3> soup;
  const std::vector<double> x = nasty_numbers();
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) soup.points.push_back({x[i], x[i + 1], x[i + 2]});
  add_tetrahedron(soup, 0, 1, 2, 3);
  expect_same(rewritten(soup), soup);
}

TEST(Ovm, KeepsPolyhedraWithWallsAndSolidCells) {
  Cell_soup<3> soup;
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i)
    soup.points.push_back({double(random() % 100), double(random() % 100), double(random() % 100)});
  auto wall = [&](std::initializer_list<std::uint32_t> loop) { soup.add_facet(loop, true); };
  add_hexahedron(soup, {0, 1, 2, 3, 4, 5, 6, 7});
  soup.add_facet({4, 7, 6, 5});  // glued to the hexahedron
  soup.add_facet({4, 5, 8});
  wall({5, 6, 8});
  soup.add_facet({6, 7, 8});
  soup.add_facet({7, 4, 8});
  soup.end_cell(true);
  add_prism(soup, {6, 5, 9, 8, 10, 11});
  add_pyramid(soup, {20, 21, 22, 23, 24});
  soup.add_facet({4, 5, 6, 7});  // a third cell on the facet of the first two
  wall({30, 31, 32, 33, 34});
  soup.add_facet({31, 30, 35});
  soup.add_facet({32, 31, 35});
  soup.end_cell();
  const Cell_soup<3> read = rewritten(soup);
  expect_same(read, soup);
}

TEST(Ovm, KeepsCellsOfThePlane) {
  Cell_soup<2> soup;
  const std::vector<double> x = nasty_numbers();
  for (std::size_t i = 0; i < 18; i += 2) soup.points.push_back({x[i], x[i + 1]});
  add_polygon(soup, std::vector<std::uint32_t>{0, 1, 2, 3});
  soup.add_facet({2, 1}, true);
  soup.add_facet({1, 5}, false);
  soup.add_facet({5, 2}, true);
  soup.end_cell(true);
  soup.impassable[1] = 1;  // the other side of the same wall
  add_polygon(soup, std::vector<std::uint32_t>{4, 6, 7, 8, 5});
  expect_same(rewritten(soup), soup);
  EXPECT_EQ(soup.impassable[4], 1);
}

TEST(Ovm, TellsThePlaneFromSpaceWithoutAPropertyToo) {
  const char* square =
      "OVM ASCII\nVertices\n3\n0 0 0\n1 0 0\n0 1 -0\nEdges\n3\n0 1\n1 2\n2 0\nFaces\n1\n3 0 2 "
      "4\nPolyhedra\n0\n";
  EXPECT_EQ(std::get<Cell_soup<2>>(parse_ovm("t.ovm", square).mesh).cell_count(), 1u);
  EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", with(square, "-0", "1")); }),
            "t.ovm: holds no polyhedra, and is no 2D environment (z is not zero throughout)");
  EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", with(square, "-0", "1") + "MProp int \"dimension\"\n2\n"); }),
            "t.ovm: is said to be of dimension 2, yet has polyhedra or z that are not zero: correct either");
}

TEST(Ovm, RefusesFacesThatAreNamedTooOften) {
  std::string text = std::string(two_tetrahedra).substr(0, std::string(two_tetrahedra).find("Polyhedra"));
  text += "Polyhedra\n1000\n";
  for (int i = 0; i < 1000; ++i) text += "4 0 2 4 6\n";
  EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", text); }),
            "t.ovm: has cells that name more halffaces than there are: some belong to several cells");
}

TEST(Ovm, RefusesWithFileAndLine) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"OVM ASCII", "OVM BINARY",
       "t.ovm:1: only OVM ASCII is read: load the binary file with OpenVolumeMesh and write it as .ovm "
       "(OpenVolumeMesh::IO::FileManager::writeFile)"},
      {"OVM ASCII", "OVM UTF8", "t.ovm:1: 'UTF8' is no encoding of OpenVolumeMesh: only OVM ASCII is read"},
      {"OVM ASCII", "OVMASCII", "t.ovm:1: not an OpenVolumeMesh file: it does not begin with 'OVM ASCII'"},
      {"OVM ASCII", "solid cube", "t.ovm:1: not an OpenVolumeMesh file: it does not begin with 'OVM ASCII'"},
      {"0 1 0\n", "0 1 zero\n", "t.ovm:6: a coordinate: 'zero' is not a number that a double can hold"},
      {"0 1 0\n", "0 1 nan\n", "t.ovm:6: a coordinate: 'nan' is not finite"},
      {"0 1 0\n", "0 1e999 0\n", "t.ovm:6: a coordinate: '1e999' is not a number that a double can hold"},
      {"0 1 0\n", "0 1\n", "t.ovm:6: a coordinate is missing"},
      {"0 1 0\n", "0 1 0 0\n",
       "t.ovm:6: '0' follows a row of the section 'Vertices', where the line should end"},
      {"Vertices\n5", "Vertices\n4", "t.ovm:8: '0' where the section 'Edges' should begin"},
      {"0 3\n", "0 5\n", "t.ovm:14: vertex 5 is out of range: there are 5, counted from 0"},
      {"0 3\n", "0 -1\n", "t.ovm:14: vertex: '-1' is not an integer >= 0"},
      {"0 3\n", "3 3\n", "t.ovm:14: an edge from vertex 3 to itself"},
      {"3 0 8 7", "3 0 8 6",
       "t.ovm:23: the halfedges form no loop: 8 ends at vertex 3, 6 starts at vertex 0"},
      {"3 0 8 7", "2 0 1", "t.ovm:23: a face of 2 halfedges: at least 3 are needed"},
      {"4 1 2 4 6", "3 1 2 4", "t.ovm:31: a polyhedron of 3 halffaces: at least 4 are needed"},
      {"4 1 2 4 6", "4 1 2 4 14", "t.ovm:31: halfface 14 is out of range: there are 14, counted from 0"},
      {"solid\"\n0\n1", "solid\"\n0\n2",
       "t.ovm:43: a value of 0 or 1: 2 is out of range: there are 2, counted from 0"},
      {"FProp bool", "HFProp bool",
       "t.ovm:33: 'HFProp bool \"impassable\"' has a meaning only as 'FProp bool' (walls), 'CProp bool' "
       "(solid cells); "
       "in 2D 'EProp bool' and 'FProp bool': rename or change it"},
      {"FProp bool \"impassable\"", "Tail",
       "t.ovm:33: 'Tail' where a property or the end of the file should be"},
      {"FProp bool \"impassable\"", "FProp bool", "t.ovm:33: a property without a name in quotes"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", with(two_tetrahedra, c.from, c.to)); }), c.message);
  }
}

TEST(Ovm, IsReadWithoutItsEncoding) {
  // As OpenVolumeMesh's own test files begin.
  for (const char* first : {"OVM", "OVM \r", "ovm"}) {
    const Mesh_file file = parse_ovm("t.ovm", with(two_tetrahedra, "OVM ASCII", first));
    EXPECT_EQ(std::get<Cell_soup<3>>(file.mesh).cell_count(), 2u) << first;
    EXPECT_EQ(file.report.format, "OpenVolumeMesh ASCII");
  }
  const Folder folder;
  EXPECT_EQ(read_mesh(folder.write("no_extension", with(two_tetrahedra, "OVM ASCII", "OVM"))).report.cells,
            2u);
}

TEST(Ovm, RefusesBinaryFilesWithAdvice) {
  const Folder folder;
  const std::string head("OVMB\n\r\n\xff\x01\x01\x00\x00", 12);
  for (const char* name : {"t.ovmb", "t.ovm", "t"})
    EXPECT_NE(
        refusal([&] {
          read_mesh(folder.write(name, head));
        }).find(":1: only OVM ASCII is read: load the binary file with OpenVolumeMesh and write it as .ovm"),
        std::string::npos)
        << name;
}

TEST(Ovm, RefusesWhatIsCutShort) {
  const std::string text = two_tetrahedra;
  EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", text.substr(0, text.find("4 0 9"))); }),
            "t.ovm:32: the file ends where row 2 of 2 of the section 'Polyhedra' should be: it is cut short");
  EXPECT_GE(refused_truncations(text, [](const std::string& t) { parse_ovm("t.ovm", t); }), 15);
}

TEST(Ovm, DoesNotTrustAnnouncedCounts) {
  EXPECT_EQ(refusal([] { parse_ovm("t.ovm", "OVM ASCII\nVertices\n18446744073709551615\n0 0 0\n"); }),
            "t.ovm:5: the file ends where row 2 of 18446744073709551615 of the section 'Vertices' should be: "
            "it is cut short");
}

TEST(Ovm, WritesNothingWhereTheSoupIsBroken) {
  const Folder folder;
  Cell_soup<3> soup;
  soup.points.assign(4, {0, 0, 0});
  add_tetrahedron(soup, 0, 1, 2, 4);
  EXPECT_EQ(refusal([&] { write_ovm(folder / "a.ovm", soup); }), "cell 0: vertex 4 does not exist");
  Cell_soup<2> plane;
  plane.points.assign(4, {0, 0});
  plane.add_facet({0, 1});
  plane.add_facet({2, 0});
  plane.add_facet({1, 2});
  plane.end_cell();
  EXPECT_EQ(refusal([&] { write_ovm(folder / "a.ovm", plane); }),
            "cell 0: its edges are not in order round it");
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace cellwalk::io
