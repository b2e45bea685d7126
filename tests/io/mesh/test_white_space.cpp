// SPDX-License-Identifier: LGPL-3.0-or-later
// One mesh, written with all the white space, comments and forms of numbers that its format allows.
#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <sstream>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

using Texts = std::vector<std::string>;

class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) {}

  const std::string& one_of(const Texts& texts) {
    return texts[std::uniform_int_distribution<std::size_t>(0, texts.size() - 1)(random_)];
  }

  /// The words of a text, with something else between them. Words such as 0.5 are numbers, which may be
  /// written otherwise, and @ is the end of a line.
  std::string spread(const std::string& text, const Texts& gaps, const Texts& ends, bool fortran) {
    std::istringstream in(text);
    std::string out, word;
    bool first = true, after_end = false;
    while (in >> word) {
      if (word == "@") {
        out += one_of(ends);
        after_end = true;
        continue;
      }
      if (!first && !after_end) out += one_of(gaps);
      first = after_end = false;
      out += word.find('.') != std::string::npos ? number(word, fortran) : word;
    }
    return out + "\n";
  }

 private:
  std::string number(const std::string& x, bool fortran) {
    Texts forms{x, x + "0", x + "e0", x + "E+00"};
    if (x.front() != '-') forms.push_back("+" + x);
    if (fortran) forms.insert(forms.end(), {x + "D+00", x + "d0"});
    return one_of(forms);
  }

  std::mt19937 random_;
};

const Texts free_gaps{" ", "  ", "\t", "\n", "\r\n", "\n\n", " \n \n", "\t \t", "\n       \n"};
const Texts line_gaps{" ", "  ", "\t", " \t "};
const Texts line_ends{"\n", "\r\n", "\n\n", " \n", "\t\n\n", "\n  \t\n"};

Texts with_comments(Texts gaps, const std::string& comment) {
  gaps.insert(gaps.end(), {" " + comment + "\n", "\n" + comment + "\n\n"});
  return gaps;
}

constexpr unsigned members = 150;

/// Expects the mesh of the canonical text in all its forms. Returns how many differ from it in their bytes.
int expect_one_mesh(const std::string& file, const std::string& canonical, const std::string& text,
                    const Texts& gaps, const Texts& ends, bool fortran) {
  const Mesh_file expected = read_mesh(file, canonical);
  std::set<std::string> different;
  for (unsigned seed = 0; seed < members; ++seed) {
    const std::string spread = Writer(seed).spread(text, gaps, ends, fortran);
    different.insert(spread);
    SCOPED_TRACE(spread);
    try {
      const Mesh_file found = read_mesh(file, spread);
      EXPECT_EQ(found.mesh.index(), expected.mesh.index());
      EXPECT_EQ(found.report.notes, expected.report.notes);
      if (const auto* soup = std::get_if<Cell_soup<3>>(&expected.mesh)) {
        const auto& same = std::get<Cell_soup<3>>(found.mesh);
        EXPECT_EQ(same.points, soup->points);
        EXPECT_EQ(same.vertices, soup->vertices);
        EXPECT_EQ(same.cell_begin, soup->cell_begin);
      } else {
        EXPECT_EQ(std::get<Surface_soup>(found.mesh).points, std::get<Surface_soup>(expected.mesh).points);
        EXPECT_EQ(std::get<Surface_soup>(found.mesh).facets, std::get<Surface_soup>(expected.mesh).facets);
      }
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
    if (testing::Test::HasFailure()) break;  // one is enough
  }
  return static_cast<int>(different.size());
}

std::string without_ends(std::string text) {
  for (std::size_t at = 0; (at = text.find('@')) != std::string::npos;) text[at] = '\n';
  return text;
}

TEST(WhiteSpace, OfMedit) {
  const std::string body =
      " Vertices 9 0.0 0.0 0.0 0 1.0 0.0 0.0 0 1.0 1.0 0.0 0 0.0 1.0 0.0 0 0.0 0.0 1.0 0 1.0 0.0 1.0 0 1.0 "
      "1.0 1.0 0 "
      "0.0 1.0 1.0 0 0.5 0.5 2.0 -1 Corners 2 1 2 Hexahedra 1 1 2 3 4 5 6 7 8 0 Pyramids 1 5 6 7 8 9 0 End";
  for (const std::string version : {"1", "2", "3", "4"}) {
    const std::string text = "MeshVersionFormatted " + version + " Dimension 3" + body;
    EXPECT_GT(
        expect_one_mesh("t.mesh", text, text, with_comments(free_gaps, "# no word: Vertices 7"), {}, true),
        100);
  }
  const Mesh_file file = read_mesh("t.mesh", "MeshVersionFormatted 2 Dimension 3" + body);
  EXPECT_EQ(file.report.cells, 2u);
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"section 'Corners' ignored"}));
}

TEST(WhiteSpace, OfMsh2) {
  const std::string text =
      "$MeshFormat @ 2.2 0 8 @ $EndMeshFormat @ $Nodes @ 5 @ 1 0.0 0.0 0.0 2 1.0 0.0 0.0 3 0.0 1.0 0.0 4 0.0 "
      "0.0 1.0 "
      "5 0.0 0.0 -1.0 @ $EndNodes @ $Elements @ 3 @ 1 2 2 7 1 1 2 3 2 4 4 1 1 1 1 1 2 3 4 3 4 4 1 1 1 2 1 3 "
      "2 5 @ "
      "$EndElements @";
  const std::string version_kept = with(text, "2.2", "2");
  EXPECT_GT(expect_one_mesh("t.msh", without_ends(version_kept), version_kept, free_gaps, line_ends, true),
            100);
}

TEST(WhiteSpace, OfMsh4) {
  const std::string text =
      "$MeshFormat @ 4.1 0 8 @ $EndMeshFormat @ $Entities @ 0 0 0 1 1 0.0 0.0 0.0 1.0 1.0 1.0 1 3 0 @ "
      "$EndEntities @ "
      "$Nodes @ 1 4 1 4 3 1 0 4 1 2 3 4 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 @ $EndNodes @ "
      "$Elements @ "
      "1 1 1 1 3 1 4 1 1 1 2 3 4 @ $EndElements @";
  // The version is a word, not a number.
  const auto spread_version = [](const std::string& t) { return with(t, "4.1 0 8", "VERSION 0 8"); };
  for (unsigned seed = 0; seed < members; ++seed) {
    const std::string spread =
        with(Writer(seed).spread(spread_version(text), free_gaps, line_ends, true), "VERSION", "4.1");
    SCOPED_TRACE(spread);
    const Mesh_file found = read_mesh("t.msh", spread), expected = read_mesh("t.msh", without_ends(text));
    EXPECT_EQ(std::get<Cell_soup<3>>(found.mesh).points, std::get<Cell_soup<3>>(expected.mesh).points);
    EXPECT_EQ(std::get<Cell_soup<3>>(found.mesh).vertices, std::get<Cell_soup<3>>(expected.mesh).vertices);
    EXPECT_EQ(found.groups, expected.groups);
    EXPECT_EQ(found.groups.size(), 1u);
  }
}

TEST(WhiteSpace, OfOff) {
  const std::string rest =
      " 4 4 0 @ 0.0 0.0 0.0 @ 1.0 0.0 0.0 @ 0.0 1.0 0.0 @ 0.0 0.0 1.0 @ 3 0 2 1 @ 3 0 1 3 @ 3 1 2 3 @ 3 2 0 "
      "3 @";
  const Texts ends = with_comments(line_ends, "# a comment");
  for (const std::string head : {"OFF", "OFF @", "COFF @"})
    EXPECT_GT(expect_one_mesh("t.off", without_ends("OFF" + rest), head + rest, line_gaps, ends, false), 100);
  // The first number may follow the keyword at once.
  const Mesh_file expected = read_mesh("t.off", without_ends("OFF" + rest));
  for (unsigned seed = 0; seed < members; ++seed) {
    const std::string spread = "OFF" + Writer(seed).spread(rest, line_gaps, ends, false);
    SCOPED_TRACE(spread);
    const Mesh_file found = read_mesh("t.off", spread);
    EXPECT_EQ(std::get<Surface_soup>(found.mesh).points, std::get<Surface_soup>(expected.mesh).points);
    EXPECT_EQ(std::get<Surface_soup>(found.mesh).facets, std::get<Surface_soup>(expected.mesh).facets);
  }
}

TEST(WhiteSpace, OfPly) {
  const std::string head =
      "ply @ format ascii 1.0 @ comment none @ element vertex 4 @ property float x @ property float y @ "
      "property float z "
      "@ element face 4 @ property list uchar int vertex_indices @ end_header @ ";
  const std::string body = "0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 3 0 2 1 3 0 1 3 3 1 2 3 3 2 0 3";
  const std::string canonical = without_ends(head) + body + "\n";
  const Mesh_file expected = read_mesh("t.ply", canonical);
  for (unsigned seed = 0; seed < members; ++seed) {
    Writer writer(seed);
    const std::string spread =
        with(writer.spread(with(head, "1.0", "VERSION"), line_gaps, line_ends, false), "VERSION", "1.0") +
        writer.spread(body, free_gaps, {}, false);
    SCOPED_TRACE(spread);
    const Mesh_file found = read_mesh("t.ply", spread);
    EXPECT_EQ(std::get<Surface_soup>(found.mesh).points, std::get<Surface_soup>(expected.mesh).points);
    EXPECT_EQ(std::get<Surface_soup>(found.mesh).facets, std::get<Surface_soup>(expected.mesh).facets);
  }
}

TEST(WhiteSpace, OfTables) {
  const Texts columns{"ax", "ay", "az", "bx", "by", "bz"};
  int with_index = 0;
  for (unsigned seed = 0; seed < members; ++seed) {
    Writer writer(seed);
    const bool has_index = writer.one_of({"y", "n"}) == "y", is_quoted = writer.one_of({"y", "n"}) == "y";
    with_index += has_index;
    std::string head, rows[2];
    if (has_index)
      head = (is_quoted ? "\"\"" : "") + writer.one_of({",", " ,", ",\t"}), rows[0] = "0,", rows[1] = "1,";
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string comma = c == 0 ? "" : writer.one_of({",", " ,", ", ", ",\t"});
      head += comma + (is_quoted ? '"' + columns[c] + '"' : columns[c]);
      for (int r : {0, 1}) rows[r] += comma + std::to_string(c) + "." + std::to_string(r);
    }
    const std::string end = writer.one_of({"\n", "\r\n", "\n\n", "\n# a comment\n"});
    const std::string text =
        writer.one_of({"", "\xef\xbb\xbf", "# a comment\n"}) + head + end + rows[0] + end + rows[1] + end;
    SCOPED_TRACE(text);
    const auto found = query_rows<3, 2>(Csv_table::parse("t.csv", text), {"a", "b"});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].error, "");
    EXPECT_EQ(found[1].points[0], (Point<3>{0.1, 1.1, 2.1}));
    EXPECT_EQ(found[1].points[1], (Point<3>{3.1, 4.1, 5.1}));
  }
  EXPECT_GT(with_index, 40);
  EXPECT_EQ(refusal([] { Csv_table::parse("t.csv", "ax,,ay\n1,2,3\n"); }),
            "t.csv:1: a column without a name");
  EXPECT_EQ(refusal([] { Csv_table::parse("t.csv", ",ax,\n1,2,3\n"); }), "t.csv:1: a column without a name");
}

}  // namespace
}  // namespace cellwalk::io
