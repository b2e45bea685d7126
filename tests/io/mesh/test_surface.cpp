// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

using Facets = std::vector<std::vector<std::uint32_t>>;

const Facets tetrahedron_facets{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const char* const off_text = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const char* const obj_text =
    "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string ascii_stl(const std::string& end) {
  const Point<3> p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::string text = "solid thing # 1\n";
  for (const auto& loop : tetrahedron_facets) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (std::uint32_t v : loop)
      text += "  vertex " + std::to_string(p[v][0]) + " " + std::to_string(p[v][1]) + " " +
              std::to_string(p[v][2]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text + end;
}

std::string binary_stl() {
  const float p[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::string bytes("solid, yet binary");
  bytes.resize(80, ' ');
  bytes.append("\4\0\0\0", 4);
  for (const auto& loop : tetrahedron_facets) {
    bytes.append(12, '\0');
    for (std::uint32_t v : loop) bytes.append(reinterpret_cast<const char*>(p[v]), sizeof p[v]);
    bytes.append(2, '\0');
  }
  return bytes;
}

const char* const ply_text =
    "ply\nformat ascii 1.0\ncomment made here\nelement vertex 4\nproperty double x\nproperty double "
    "y\nproperty double z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

Surface_soup parse(const std::string& bytes, Surface_format format, Read_report* report = nullptr) {
  return parse_surface("t", bytes, format, report);
}

void expect_tetrahedron(const Surface_soup& soup) {
  EXPECT_EQ(soup.points.size(), 4u);
  ASSERT_EQ(soup.facets.size(), 4u);
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Point<3> expected[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      EXPECT_EQ(soup.points.at(soup.facets[f].at(i)), expected[tetrahedron_facets[f][i]]);
    }
}

TEST(Surface, OffIsReadInItsVariants) {
  expect_tetrahedron(parse(off_text, Surface_format::off));
  expect_tetrahedron(parse(with(off_text, "OFF\n4 4 0", "OFF 4 4 0 # counts"), Surface_format::off));
  expect_tetrahedron(
      parse(with(off_text, "OFF\n", "# first\n\n4 4 0\n").replace(12, 6, ""), Surface_format::off));
  expect_tetrahedron(
      parse(with(off_text, "OFF\n4 4 0\n0 0 0", "COFF\n4 4 0\n0 0 0 255 0 0 255"), Surface_format::off));
  expect_tetrahedron(parse(with(off_text, "3 1 2 3", "3 1 2 3 0.5 0.5 0.5"), Surface_format::off));
  Read_report report;
  expect_tetrahedron(
      parse(with(off_text, "3 1 2 3\n", "group hull\n3 1 2 3\n"), Surface_format::off, &report));
  EXPECT_EQ(report.notes, (std::vector<std::string>{"1 'group' lines ignored"}));
  EXPECT_EQ(report.points, 4u);
  EXPECT_EQ(report.facets, 4u);
}

TEST(Surface, OffIsReadAsBinaryToo) {
  std::string bytes = "OFF BINARY\n";
  const auto append = [&](auto value) {
    const auto* p = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof value; i-- > 0;) bytes.push_back(p[i]);  // big endian
  };
  for (std::uint32_t n : {4, 4, 0}) append(n);
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) append(x);
  for (const auto& loop : tetrahedron_facets) {
    append(std::uint32_t{3});
    for (std::uint32_t v : loop) append(v);
    append(std::uint32_t{1});  // one colour
    append(0.5F);
  }
  Read_report report;
  expect_tetrahedron(parse(bytes, Surface_format::off, &report));
  EXPECT_EQ(report.format, "OFF (binary)");
  EXPECT_TRUE(report.notes.empty());
  parse(bytes + "12345", Surface_format::off, &report);
  EXPECT_EQ(report.notes, (std::vector<std::string>{"5 bytes after the last facet ignored"}));
  EXPECT_EQ(refusal([&] { parse(bytes.substr(0, 50), Surface_format::off); }),
            "t: the file ends where a vertex should be: it is cut short");
  EXPECT_GE(refused_truncations(bytes, [](const std::string& t) { parse(t, Surface_format::off); }), 20);
}

/// A file whose header announces fewer facets than it holds would lose them, and walls with them, unnoticed.
TEST(Surface, LinesThatTheHeaderDoesNotCountAreNoted) {
  const auto notes = [](const std::string& text, Surface_format format) {
    Read_report report;
    parse(text, format, &report);
    return report.notes;
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(notes(with(off_text, "4 4 0", "4 2 0"), Surface_format::off),
            (Lines{"2 lines after the last facet ignored"}));
  EXPECT_EQ(notes(std::string(off_text) + "\n# the end\n \n", Surface_format::off), Lines{});
  EXPECT_EQ(notes(with(ply_text, "face 4", "face 2"), Surface_format::ply),
            (Lines{"2 lines after the last element ignored"}));
  EXPECT_EQ(notes(with(ply_text, "3 2 0 3\n", "3 2 0 3 7"), Surface_format::ply),
            (Lines{"1 lines after the last element ignored"}));
  EXPECT_EQ(notes(std::string(ply_text) + " \n\n", Surface_format::ply), Lines{});
}

TEST(Surface, OffIsRefusedWithFileAndLine) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"OFF", "PFF", "t:1: not an OFF file: it begins with 'PFF'"},
      {"OFF", "4OFF", "t:1: '4OFF' holds points that are not in 3-space: only three coordinates are read"},
      {"4 4 0", "4 x 0", "t:2: the number of facets: 'x' is not an integer >= 0"},
      {"1 0 0\n", "1 0\n", "t:4: a coordinate is missing"},
      {"1 0 0\n", "1 0 O\n", "t:4: a coordinate: 'O' is not a number that a double can hold"},
      {"3 1 2 3", "3 1 2 4", "t:9: vertex 4 is out of range: there are 4, counted from 0"},
      {"3 1 2 3", "4 1 2 3", "t:9: vertex is missing"},
      {"4 4 0", "4 5 0", "t:11: the file ends where facet 5 of 5 should be: it is cut short"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse(with(off_text, c.from, c.to), Surface_format::off); }), c.message);
  }
  EXPECT_EQ(refusal([] { parse("OFF\n1 0 0\n0 0 0\n", Surface_format::off); }),
            "t: holds no polygons: a surface is needed");
}

TEST(Surface, ObjIsReadInItsVariants) {
  Read_report report;
  expect_tetrahedron(parse(obj_text, Surface_format::obj, &report));
  EXPECT_TRUE(report.notes.empty());
  expect_tetrahedron(parse(with(obj_text, "f 2 3 4", "g hull\r\nusemtl red\nvt 0 1\nf 2/1/7 3//7 -1/1"),
                           Surface_format::obj, &report));
  EXPECT_EQ(report.notes, (std::vector<std::string>{"statements ignored: g, usemtl, vt"}));
  expect_tetrahedron(parse(with(obj_text, "f 2 3 4", "f 2 \\\n 3 4"), Surface_format::obj));
  expect_tetrahedron(parse("f 1 3 2\n" + with(obj_text, "f 1 3 2\n", ""), Surface_format::obj));
}

TEST(Surface, ObjIsRefusedWithFileAndLine) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"f 2 3 4", "f 2 3 5", "t:8: a face names vertex 5, of 4"},
      {"f 2 3 4", "f 2 3 0",
       "t:8: '0' is not a corner of a face: an index counted from 1, or a negative one"},
      {"f 2 3 4", "f 2 3 -5", "t:8: corner '-5' of a face names a vertex that does not exist"},
      {"f 2 3 4", "f 2 3 x",
       "t:8: 'x' is not a corner of a face: an index counted from 1, or a negative one"},
      {"v 1 0 0", "v 1 0", "t:3: a coordinate is missing"},
      {"v 1 0 0", "\x01\x02", "t:3: '?\?' opens no statement of an OBJ file"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse(with(obj_text, c.from, c.to), Surface_format::obj); }), c.message);
  }
}

TEST(Surface, FacesOfObjWithFewerThanThreeVerticesAreLeftOut) {
  Read_report report;
  expect_tetrahedron(
      parse(with(obj_text, "f 2 3 4", "f 2 \\\n 3\nf 2 3 4\nf\nf 1"), Surface_format::obj, &report));
  EXPECT_EQ(report.notes,
            (std::vector<std::string>{"3 faces of fewer than 3 vertices left out, the first at line 8"}));
  expect_tetrahedron(parse(with(obj_text, "f 2 3 4", "f 2 3 4\nf 2 3"), Surface_format::obj, &report));
  EXPECT_EQ(report.notes,
            (std::vector<std::string>{"1 face of fewer than 3 vertices left out, the first at line 9"}));
  EXPECT_EQ(refusal([] { parse(with(obj_text, "f 2 3 4", "f 2 9"), Surface_format::obj); }),
            "t:8: a face names vertex 9, of 4");
  EXPECT_EQ(refusal([] { parse("v 0 0 0\nv 1 0 0\nf 1 2\n", Surface_format::obj); }),
            "t: holds no polygons: a surface is needed");
}

TEST(Surface, StlIsReadAsTextAndBinary) {
  Read_report report;
  expect_tetrahedron(parse(ascii_stl("endsolid thing\n"), Surface_format::stl, &report));
  EXPECT_EQ(report.format, "STL");
  expect_tetrahedron(parse(ascii_stl("end solid\n"), Surface_format::stl));
  expect_tetrahedron(parse(ascii_stl(""), Surface_format::stl));
  expect_tetrahedron(parse("\xef\xbb\xbf" + ascii_stl(""), Surface_format::stl));  // a byte order mark
  expect_tetrahedron(parse(binary_stl(), Surface_format::stl, &report));
  EXPECT_EQ(report.format, "STL (binary)");
  parse(binary_stl() + "tail", Surface_format::stl, &report);
  const Surface_soup twice =
      parse(ascii_stl("endsolid\n") + ascii_stl("endsolid\n"), Surface_format::stl, &report);
  EXPECT_EQ(twice.points.size(), 4u);
  EXPECT_EQ(twice.facets.size(), 8u);
  EXPECT_EQ(report.notes, (std::vector<std::string>{"2 solids read as one surface"}));
}

TEST(Surface, StlMergesZeroWithNegativeZero) {
  const Surface_soup soup =
      parse(with(ascii_stl(""), "vertex 0.000000 0.000000", "vertex -0.0 0.000000"), Surface_format::stl);
  expect_tetrahedron(soup);
}

TEST(Surface, StlIsRefusedWithFileAndLine) {
  const std::string text = ascii_stl("endsolid\n");
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"  vertex", "  vertx", "t:4: 'vertx' opens no statement of an STL file"},
      {"facet normal 0 0 0\n", "", "t:3: a vertex outside any facet"},
      {"endfacet\n", "", "t:8: a facet begins before the one before it ended"},
      {"  vertex 0.000000 1.000000 0.000000\n", "", "t:7: a facet of 2 vertices: at least 3 are needed"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse(with(text, c.from, c.to), Surface_format::stl); }), c.message);
  }
  EXPECT_EQ(refusal([&] { parse(text.substr(0, text.rfind("endfacet")), Surface_format::stl); }),
            "t:29: the file ends inside a facet: it is cut short");
  std::string cut = binary_stl();
  cut[0] = 'S' + 1;
  cut.resize(200);
  EXPECT_EQ(refusal([&] { parse(cut, Surface_format::stl); }),
            "t: a binary STL that announces 4 triangles and holds 2: it is cut short, or no STL");
  EXPECT_EQ(refusal([&] { parse("hello", Surface_format::stl); }), "t: too short for an STL file");
}

TEST(Surface, PlyIsRead) {
  expect_tetrahedron(parse(ply_text, Surface_format::ply));
  std::string big_endian = with(ply_text, "ascii", "binary_big_endian");
  big_endian = with(big_endian.substr(0, big_endian.find("end_header") + 11), "int vertex", "ushort vertex");
  for (double x : {0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.}) {
    const auto* bytes = reinterpret_cast<const char*>(&x);
    for (std::size_t i = sizeof x; i-- > 0;) big_endian.push_back(bytes[i]);
  }
  for (const auto& loop : tetrahedron_facets) {
    big_endian.push_back('\3');
    for (std::uint32_t v : loop) big_endian.append(1, '\0').push_back(static_cast<char>(v));
  }
  Read_report report;
  expect_tetrahedron(parse(big_endian, Surface_format::ply, &report));
  EXPECT_TRUE(report.notes.empty());
  parse(big_endian + "12345", Surface_format::ply, &report);
  EXPECT_EQ(report.notes, (std::vector<std::string>{"5 bytes after the last element ignored"}));
}

TEST(Surface, StripsOfPlyAreTriangles) {
  // A tetrahedron in one strip, and in two that a repeated vertex or -1 keeps apart.
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const auto facets = [&](const std::string& strip) {
    return parse(head + strip, Surface_format::ply).facets;
  };
  EXPECT_EQ(facets("6 0 2 1 3 0 2\n"), (Facets{{0, 2, 1}, {1, 2, 3}, {1, 3, 0}, {0, 3, 2}}));
  EXPECT_EQ(facets("7 0 2 1 -1 1 2 3\n"), (Facets{{0, 2, 1}, {1, 2, 3}}));
  EXPECT_EQ(facets("7 0 2 1 1 3 0 2\n"), (Facets{{0, 2, 1}, {3, 1, 0}, {3, 0, 2}}));
  EXPECT_EQ(refusal([&] { facets("3 0 1 9\n"); }).find("t"), 0u);
  EXPECT_EQ(refusal([&] { parse(with(head, "vertex_indices", "corners") + "0\n", Surface_format::ply); }),
            "t:13: the header gives strips of triangles no list 'vertex_indices'");
}

TEST(Surface, PlyIsRefusedWithAReason) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {{"ply\n", "plx\n", "t:1: not a PLY file: it does not begin with 'ply'"},
                        {"ascii", "text", "t:2: 'text' is no format of PLY"},
                        {"format ascii 1.0\n", "", "t:9: the header has no line 'format'"},
                        {"comment made here", "property float a", "t:3: a property before any element"},
                        {"element vertex 4", "element vertex 4000000000",
                         "t:19: the file ends where a vertex should be: it is cut short"},
                        {"double z", "doubel z", "t:7: 'doubel' is no type of PLY"},
                        {"double z", "double w", "t:10: the header gives vertices no property 'z'"},
                        {"element face", "element facet", "t: holds no polygons: a surface is needed"},
                        {"end_header", "the end", "t:10: 'the' opens no line of a PLY header"},
                        {"list uchar int vertex_indices", "int colour",
                         "t:14: the header gives faces no list 'vertex_indices': a surface is needed"},
                        {"3 1 2 3", "3 1 2 4", "t:18: facet 2 names vertex 4, of 4"},
                        {"3 1 2 3", "3 1 2 3.5", "t:17: facet 2 names vertex 3.5"},
                        {"3 1 2 3", "3 1 2 x", "t:17: a facet: 'x' is not a number"},
                        {"3 1 2 3", "2 1 2", "t:17: facet 2 has 2 vertices: at least 3 are needed"},
                        {"3 1 2 3", "99 1 2 3", "t:17: a list of 99 values: the file is cut short or broken"},
                        {"3 1 2 3\n3 2 0 3\n", "",
                         "t:17: the file ends where the length of a list should be: it is cut short"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse(with(ply_text, c.from, c.to), Surface_format::ply); }), c.message);
  }
}

TEST(Surface, CompressedFilesAreRead) {
  const Folder folder;
  gzFile out = gzopen((folder / "t.off.gz").c_str(), "wb");
  gzwrite(out, off_text, static_cast<unsigned>(std::strlen(off_text)));
  gzclose(out);
  expect_tetrahedron(read_surface(folder / "t.off.gz"));
  const std::string packed = content_of(folder / "t.off.gz");
  folder.write("cut.off.gz", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(refusal([&] { read_surface(folder / "cut.off.gz"); }),
            (folder / "cut.off.gz").string() +
                ": the gzip stream is damaged or cut short: copy or compress the file again");
  folder.write("twice.off.gz", packed + packed);  // two members are one text
  EXPECT_EQ(read_surface(folder / "twice.off.gz").facets.size(), 4u);
}

TEST(Surface, UnreadableFilesAreNamed) {
  const Folder folder;
  EXPECT_EQ(refusal([&] { read_surface(folder / "none.off"); }),
            (folder / "none.off").string() + ": cannot be opened: check that it exists and may be read");
  EXPECT_EQ(
      refusal([&] { read_surface(folder.write("t.txt", off_text)); }),
      (folder / "t.txt").string() +
          ": not a surface by its extension: .off, .obj, .stl and .ply are read, also with .gz after it");
}

TEST(Surface, TruncatedFilesNeverCrash) {
  EXPECT_GE(refused_truncations(off_text, [](const std::string& t) { parse(t, Surface_format::off); }), 19);
  EXPECT_GE(refused_truncations(obj_text, [](const std::string& t) { parse(t, Surface_format::obj); }), 10);
  EXPECT_GE(refused_truncations(ascii_stl(""), [](const std::string& t) { parse(t, Surface_format::stl); }),
            15);
  EXPECT_GE(refused_truncations(binary_stl(), [](const std::string& t) { parse(t, Surface_format::stl); }),
            20);
  EXPECT_GE(refused_truncations(ply_text, [](const std::string& t) { parse(t, Surface_format::ply); }), 18);
}

}  // namespace
}  // namespace cellwalk::io
