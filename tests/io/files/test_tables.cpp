// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/io/query_file.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

TEST(Csv, ColumnsAreFoundByName) {
  const Csv_table table = Csv_table::parse(
      "t.csv",
      "\xef\xbb\xbf# a comment\r\n\r\nx, \"the y\" ,z\r\n1,2,\"a \"\"b\"\", c\"\r\n# no\r\n\n4,,6\n");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"x", "the y", "z"}));
  ASSERT_EQ(table.row_count(), 2u);
  EXPECT_EQ(table.column("the y"), 1u);
  EXPECT_FALSE(table.find_column("w"));
  EXPECT_EQ(table.field(0, 2), "a \"b\", c");
  EXPECT_EQ(table.number(1, 0).value, 4);
  EXPECT_EQ(table.number(1, 1).reason, "the y: an empty field where a number is expected");
  EXPECT_EQ(table.line(0), 4u);
  EXPECT_EQ(table.line(1), 7u);
}

/// The rows of all parts, one after the other, are those of the whole table, with their lines.
TEST(Csv, AZeroByteBelongsToItsField) {
  const Csv_table table = Csv_table::parse("t.csv", std::string("x,y\n1,2\0junk\n\0\0\n", 15));
  ASSERT_EQ(table.row_count(), 2u);
  EXPECT_EQ(table.number(0, 1).reason, "y: '2?junk' is not a number that a double can hold");
  EXPECT_TRUE(table.row_problem(1));
}

TEST(Csv, PartsTogetherAreTheTable) {
  const std::string texts[] = {"# a comment\nx,y\n", "x,y\n1,2", "x,y\n1,2\n\n# no\n3,4\n5,6,7\n8,9\r\n",
                               "\xef\xbb\xbfx,y\n\n\n\n1,2\n\n\n\n\n\n\n\n3,4\n\n",
                               "x\n1\n22\n333\n4444\n55555\n666666\n7777777\n88888888\n"};
  for (const std::string& text : texts)
    for (std::size_t count = 1; count <= 9; ++count) {
      const Csv_table whole = Csv_table::parse("t.csv", text);
      std::size_t row = 0;
      for (std::size_t number = 0; number < count; ++number) {
        const Csv_table part = Csv_table::parse("t.csv", text, {number, count});
        EXPECT_EQ(part.columns(), whole.columns());
        for (std::size_t r = 0; r < part.row_count(); ++r, ++row) {
          ASSERT_LT(row, whole.row_count());
          EXPECT_EQ(part.line(r), whole.line(row)) << text << count;
          EXPECT_EQ(part.row_problem(r), whole.row_problem(row));
          for (std::size_t c = 0; c < whole.columns().size(); ++c)
            EXPECT_EQ(part.field(r, c), whole.field(row, c));
        }
      }
      EXPECT_EQ(row, whole.row_count()) << text << count;
    }
}

TEST(Csv, PartsNameTheLineOfAnError) {
  const std::string text = "x\n1\n2\n3\n\"4\n5\n";
  int refused = 0;
  for (std::size_t number = 0; number < 3; ++number) try {
      Csv_table::parse("t.csv", text, {number, 3});
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "t.csv:5: a quote is left open");
      ++refused;
    }
  EXPECT_EQ(refused, 1);
}

TEST(Csv, RowsAreWrittenIntoATextAlike) {
  std::string text;
  Csv_writer rows(text, 2);
  rows.row(1, "a,b");
  rows.row(0.5, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(text, "1,\"a,b\"\n0.5,\n");
}

TEST(Csv, IsRefusedWithFileAndLine) {
  const auto why = [](const char* text) { return refusal([&] { Csv_table::parse("t.csv", text); }); };
  EXPECT_EQ(why("# only a comment\n"),
            "t.csv: holds no header: the names of the columns are to stand in its first line");
  EXPECT_EQ(why("\na,b,a\n"), "t.csv:2: two columns are named 'a'");
  EXPECT_EQ(why("a,,b\n"), "t.csv:1: a column without a name");
  EXPECT_EQ(why("a,b\n1,\"2\n"), "t.csv:2: a quote is left open");
  EXPECT_EQ(why("a,b\n\"1\"2,3\n"), "t.csv:2: text follows a quoted field, where a comma should be");
  EXPECT_EQ(refusal([] { Csv_table::parse("t.csv", "a,b\n").column("c"); }),
            "t.csv: has no column 'c': its header names a,b");
}

TEST(Csv, TablesOfManyColumnsAreReadAsFastAsOfFew) {
  // A comparison of each name with those before it would take minutes.
  constexpr std::size_t count = 300'000;
  std::string text;
  for (std::size_t c = 0; c < count; ++c) text += (c == 0 ? "c" : ",c") + std::to_string(c);
  const Csv_table table = Csv_table::parse("t.csv", text + "\n");
  EXPECT_EQ(table.columns().size(), count);
  EXPECT_EQ(table.column("c299999"), count - 1);
  EXPECT_EQ(refusal([&] { table.column("x"); }),
            "t.csv: has no column 'x': its header names "
            "c0,c1,c2,c3,c4,c5,c6,c7,c8,c9,c10,c11,c12,c13,c14,c15,c16,c17,"
            "c18,c19 and 299980 more");
  EXPECT_EQ(refusal([&] { Csv_table::parse("t.csv", text + ",c7\n"); }),
            "t.csv:1: two columns are named 'c7'");
}

TEST(Csv, WrittenTablesReadBackTheSame) {
  const Folder folder;
  Csv_writer out(folder / "t.csv", {"row", "value", "text"});
  out.row(1, 0.1, "plain");
  out.row(std::size_t{2}, -5e-324, std::string("a,\"b\""));
  out.row(-3, std::numeric_limits<double>::quiet_NaN(), "# two\nlines");
  EXPECT_EQ(refusal([&] { out.row(1, 2); }, Error_code::usage), "a row of 2 values for 3 columns");
  EXPECT_FALSE(std::filesystem::exists(folder / "t.csv"));
  out.commit();
  EXPECT_EQ(content_of(folder / "t.csv"),
            "row,value,text\n1,0.1,plain\n2,-5e-324,\"a,\"\"b\"\"\"\n-3,,\"# two lines\"\n");
  const Csv_table table = Csv_table::read(folder / "t.csv");
  EXPECT_EQ(table.number(1, 1).value, -5e-324);
  EXPECT_EQ(table.field(1, 2), "a,\"b\"");
}

TEST(QueryFiles, RowsCarryTheirLineAndWhatIsWrongWithThem) {
  const Csv_table table = Csv_table::parse("q.csv",
                                           "id,bx,by,bz,ax,ay,az\n"
                                           "0,1,2,3,0x1p-1,1/4,-0\n"
                                           "1,1,2,3,1/3,0,0\n"
                                           "\n"
                                           "2,1,2,3,0,0\n"
                                           "3,1,2,inf,0,0,0\n"
                                           "4,1,2,3,0,0,0,0\n");
  const auto rows = query_rows<3, 2>(table, {"a", "b"});
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0].points[0], (Point<3>{0.5, 0.25, 0}));
  EXPECT_EQ(rows[0].points[1], (Point<3>{1, 2, 3}));
  EXPECT_EQ(rows[0].error, "");
  EXPECT_EQ(rows[1].error, "ax: the fraction '1/3' is not exactly a double");
  EXPECT_EQ(rows[2].error, "6 fields, where the header has 7");
  EXPECT_EQ(rows[3].error, "bz: 'inf' is not finite");
  EXPECT_EQ(rows[4].error, "8 fields, where the header has 7");
  EXPECT_EQ(rows[2].line, 5u);
}

template <int D>
std::vector<Query_row<D, 2>> moves_of(const std::filesystem::path& path) {
  return query_rows<D, 2>(Csv_table::read(path), {"a", "b"});
}
template <int D>
std::vector<Query_row<D, 3>> sweeps_of(const std::filesystem::path& path) {
  return query_rows<D, 3>(Csv_table::read(path), {"p", "t", "q"});
}

TEST(QueryFiles, RadiiAreOfTheRowOrOfAll) {
  const Folder folder;
  const auto own =
      folder.write("own.csv", "ax,ay,bx,by,radius\n1,2,3,4,0.5\n1,2,3,4,-1\n1,2,3,4,inf\n1,2,3,4,-0\n");
  const auto rows = query_rows<2, 2>(Csv_table::read(own), {"a", "b"}, 9);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].radius, 0.5);
  EXPECT_EQ(rows[1].error, "radius: takes a finite number of at least 0, not -1");
  EXPECT_EQ(rows[2].error, "radius: 'inf' is not finite");
  EXPECT_EQ(rows[3].radius, 0);
  EXPECT_EQ(rows[3].error, "");
  const auto none = folder.write("none.csv", "ax,ay,bx,by\n1,2,3,4\n");
  EXPECT_EQ((query_rows<2, 2>(Csv_table::read(none), {"a", "b"}, 9)[0].radius), 9);
  EXPECT_EQ(moves_of<2>(none)[0].radius, 0);
}

TEST(QueryFiles, TheDimensionMustFit) {
  const Folder folder;
  const auto plane = folder.write("p.csv", "ax,ay,bx,by\n1,2,3,4\n"),
             space = folder.write("s.csv", "ax,ay,az,bx,by,bz\n");
  EXPECT_EQ(moves_of<2>(plane)[0].points[1], (Point<2>{3, 4}));
  EXPECT_EQ(refusal([&] { moves_of<3>(plane); }),
            plane.string() + ": has no column 'az': its header names ax,ay,bx,by");
  EXPECT_EQ(refusal([&] { moves_of<2>(space); }),
            space.string() + ": has a column 'az', and the environment is 2D: leave z out");
  EXPECT_TRUE(moves_of<3>(space).empty());
}

TEST(QueryFiles, SweepsHaveAnEndThatMovesAndOneThatStands) {
  const Folder folder;
  const auto plane = folder.write("p.csv", "qx,qy,px,py,tx,ty\n5,6,1,2,3,4\n");
  const auto rows = sweeps_of<2>(plane);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].points, (std::array<Point<2>, 3>{{{1, 2}, {3, 4}, {5, 6}}}));
  EXPECT_EQ(refusal([&] { sweeps_of<3>(plane); }),
            plane.string() + ": has no column 'pz': its header names qx,qy,px,py,tx,ty");
  EXPECT_EQ(refusal([&] { moves_of<2>(plane); }),
            plane.string() + ": has no column 'ax': its header names qx,qy,px,py,tx,ty");
  const auto mixed = folder.write("m.csv", "px,py,tx,ty,qx,qy,qz\n1,2,3,4,5,6,7\n");
  EXPECT_EQ(refusal([&] { sweeps_of<2>(mixed); }),
            mixed.string() + ": has a column 'qz', and the environment is 2D: leave z out");
}

TEST(Json, IsWrittenInOrder) {
  const Folder folder;
  nlohmann::ordered_json value;
  value["z"] = 0.1;
  value["a"] = {1, 2};
  value["nan"] = std::numeric_limits<double>::quiet_NaN();
  value["name"] = "a\xff";
  write_json(folder / "t.json", value);
  EXPECT_EQ(content_of(folder / "t.json"),
            "{\n  \"z\": 0.1,\n  \"a\": [\n    1,\n    2\n  ],\n  \"nan\": null,\n  \"name\": "
            "\"a\xef\xbf\xbd\"\n}\n");
}

}  // namespace
}  // namespace cellwalk::io
