// SPDX-License-Identifier: LGPL-3.0-or-later
// Named groups of facets and cells in .ovm files.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

/// Two tetrahedra with a common facet, and a face of no cell.
const char* const cells_with_groups = R"(OVM ASCII
Vertices
5
0 0 0
1 0 0
0 1 0
0 0 1
0 0 -1
Edges
10
0 1
1 2
2 0
0 3
1 3
2 3
0 4
1 4
2 4
3 4
Faces
8
3 0 2 4
3 0 8 7
3 2 10 9
3 4 6 11
3 0 14 13
3 2 16 15
3 4 12 17
3 6 18 13
Polyhedra
2
4 1 2 4 6
4 0 9 11 13
FProp bool "group valve"
1
0
0
1
0
0
0
0
CProp bool "group lower part"
0
1
CProp bool "group valve"
1
0
)";

const char* const square_with_groups = R"(OVM ASCII
Vertices
4
0 0 0
1 0 0
1 1 0
0 1 0
Edges
5
0 1
1 2
2 0
2 3
3 0
Faces
2
3 0 2 4
3 5 6 8
Polyhedra
0
EProp bool "group valve"
0 0 1 1 0
FProp bool "group upper"
0 1
)";

TEST(OvmGroups, AreReadWithBothSidesOfFacets) {
  const Mesh_file file = parse_ovm("t.ovm", cells_with_groups);
  EXPECT_EQ(file.groups, (Soup_groups{{"lower part", {{}, {1}}}, {"valve", {{0, 3, 4}, {0}}}}));
  EXPECT_TRUE(file.report.notes.empty());
  const Mesh_file plane = parse_ovm("t.ovm", square_with_groups);
  EXPECT_EQ(plane.groups, (Soup_groups{{"upper", {{}, {1}}}, {"valve", {{2, 3, 4}, {}}}}));
  EXPECT_TRUE(plane.report.notes.empty());
}

TEST(OvmGroups, WhatHasNoMeaningIsNoted) {
  const std::string face_of_no_cell = with(cells_with_groups, "0\n0\n0\n0\nCProp", "0\n0\n0\n1\nCProp");
  const Mesh_file file = parse_ovm("t.ovm", face_of_no_cell);
  EXPECT_EQ(file.groups.at("valve"), (Soup_group{{0, 3, 4}, {0}}));
  EXPECT_EQ(file.report.notes,
            std::vector<std::string>{"group \"valve\": 1 of its facets belong to no cell: left out"});
  const Mesh_file edges =
      parse_ovm("t.ovm", with(cells_with_groups, "FProp bool \"group valve\"\n1\n0\n0\n1\n0\n0\n0\n0\n",
                              "EProp bool \"group ridge\"\n1 0 0 0 0 0 0 0 0 0\n"));
  EXPECT_EQ(edges.groups, (Soup_groups{{"lower part", {{}, {1}}}, {"valve", {{}, {0}}}}));
  EXPECT_EQ(edges.report.notes,
            std::vector<std::string>{"group \"ridge\" of edges has no meaning in 3D: ignored"});
}

TEST(OvmGroups, AreRefusedWithTheLine) {
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {"FProp bool \"group valve\"", "FProp int \"group valve\"",
       "t.ovm:35: 'FProp int \"group valve\"': a group is 'FProp bool' (facets) or 'CProp bool' (cells), in "
       "2D "
       "'EProp bool' and 'FProp bool': rename or change it"},
      {"FProp bool \"group valve\"", "VProp bool \"group valve\"",
       "t.ovm:35: 'VProp bool \"group valve\"': a group is 'FProp bool' (facets) or 'CProp bool' (cells), in "
       "2D "
       "'EProp bool' and 'FProp bool': rename or change it"},
      {"\"group lower part\"", "\"group \"", "t.ovm:44: a group without a name: write \"group NAME\""},
      {"\"group lower part\"", "\"group\"", "t.ovm:44: a group without a name: write \"group NAME\""},
      {"\"group lower part\"", "\"group valve\"", "t.ovm:47: this property occurs twice"},
      {"part\"\n0\n1", "part\"\n0\n2",
       "t.ovm:46: a value of 0 or 1: 2 is out of range: there are 2, counted from 0"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    EXPECT_EQ(refusal([&] { parse_ovm("t.ovm", with(cells_with_groups, c.from, c.to)); }), c.message);
  }
  EXPECT_GE(refused_truncations(cells_with_groups, [](const std::string& t) { parse_ovm("t.ovm", t); }), 15);
  // Other properties are ignored as before.
  EXPECT_EQ(
      parse_ovm("t.ovm", with(cells_with_groups, "CProp bool \"group lower part\"", "CProp int \"grouping\""))
          .report.notes,
      std::vector<std::string>{"property CProp \"grouping\" ignored"});
}

template <int D>
void expect_written(const char* text) {
  const Folder folder;
  const Mesh_file file = parse_ovm("t.ovm", text);
  const auto& soup = std::get<Cell_soup<D>>(file.mesh);
  Soup_groups groups = file.groups;
  groups["empty"];
  groups["group"] = {{0}, {0, 1}};
  // One side of a facet suffices.
  groups["one side"].facets = {groups["valve"].facets.back()};
  write_ovm(folder / "a.ovm", soup, groups);
  const Mesh_file again = read_ovm(folder / "a.ovm");
  EXPECT_EQ(again.groups.size(), groups.size());
  for (const auto& [name, group] : groups) {
    EXPECT_EQ(again.groups.at(name).cells, group.cells) << name;
    EXPECT_TRUE(std::ranges::includes(again.groups.at(name).facets, group.facets)) << name;
  }
  EXPECT_EQ(again.groups.at("valve"), file.groups.at("valve"));
  EXPECT_EQ(again.groups.at("one side").facets.size(), 2u);
  // One of facets only is written once, and not for cells as well.
  const std::string text_written = content_of(folder / "a.ovm"), title = "\"group one side\"";
  EXPECT_NE(text_written.find(title), std::string::npos);
  EXPECT_EQ(text_written.find(title), text_written.rfind(title));
  write_ovm(folder / "b.ovm", std::get<Cell_soup<D>>(again.mesh), again.groups);
  EXPECT_EQ(content_of(folder / "a.ovm"), content_of(folder / "b.ovm"));
  write_ovm(folder / "c.ovm", soup);
  EXPECT_TRUE(read_ovm(folder / "c.ovm").groups.empty());
}

TEST(OvmGroups, AreWritten2) {
  std::string text = square_with_groups;
  text = with(text.c_str(), "0 0 1 1 0", "0 0 1 0 0");
  expect_written<2>(text.c_str());
}
TEST(OvmGroups, AreWritten3) {
  expect_written<3>(with(cells_with_groups, "1\n0\n0\n1\n", "1\n0\n0\n0\n").c_str());
}

TEST(OvmGroups, AreNotWrittenIfTheyAreBroken) {
  const Folder folder;
  const Mesh_file file = parse_ovm("t.ovm", cells_with_groups);
  const auto refused = [&](const std::string& name, const Soup_group& group) {
    return refusal([&] { write_ovm(folder / "a.ovm", std::get<Cell_soup<3>>(file.mesh), {{name, group}}); });
  };
  EXPECT_EQ(refused("a", {{8}, {}}), "group \"a\" has facet 8 of 8");
  EXPECT_EQ(refused("a", {{}, {2}}), "group \"a\" has cell 2 of 2");
  EXPECT_EQ(refused("", {}), "group \"\" needs a name without quotes and control characters");
  EXPECT_EQ(refused("a\"b", {}), "group \"a\"b\" needs a name without quotes and control characters");
  EXPECT_NE(refused("a\nb", {}).find("needs a name without"), std::string::npos);
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace cellwalk::io
