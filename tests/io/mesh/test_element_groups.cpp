// SPDX-License-Identifier: LGPL-3.0-or-later
// Physical groups of .msh, and groups of I-deas, as groups of facets and cells.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

using Numbers = std::vector<std::uint32_t>;
using Notes = std::vector<std::string>;

// Two tetrahedra with a common facet, 2 3 4.
const std::string five_nodes = "5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n";
const std::string names =
    "$PhysicalNames\n4\n2 7 \"inlet of A\"\n2 8 \"middle\"\n3 1 \"blood\"\n1 3 \"rim\"\n$EndPhysicalNames\n";
const std::string version_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n" + five_nodes +
                              "$EndNodes\n$Elements\n6\n1 2 2 7 1 1 2 3\n2 2 2 8 2 3 2 4\n3 2 2 7 1 1 2 5\n"
                              "4 4 2 1 1 1 2 3 4\n5 4 2 2 1 2 4 3 5\n6 1 2 3 1 1 2\n$EndElements\n";
const std::string version_4_1 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
    "$Entities\n0 1 2 2\n1 0 0 0 1 1 1 1 3 0\n1 0 0 0 1 1 1 1 7 0\n2 0 0 0 1 1 1 1 8 0\n1 0 0 0 1 1 1 1 1 0\n"
    "2 0 0 0 1 1 1 1 2 0\n$EndEntities\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 "
    "1\n1 1 1\n"
    "$EndNodes\n$Elements\n5 6 1 6\n2 1 2 2\n1 1 2 3\n3 1 2 5\n2 2 2 1\n2 3 2 4\n3 1 4 1\n4 1 2 3 4\n"
    "3 2 4 1\n5 2 4 3 5\n1 1 1 1\n6 1 2\n$EndElements\n";

TEST(ElementGroups, PhysicalGroupsAreThoseOfFacetsAndCells) {
  for (const std::string& text : {version_2, version_4_1}) {
    SCOPED_TRACE(text);
    const Mesh_file file = read_mesh("t.msh", text);
    const auto& soup = std::get<Cell_soup<3>>(file.mesh);
    ASSERT_EQ(file.groups.size(), 4u);
    EXPECT_EQ(file.groups.at("blood"), (Soup_group{{}, {0}}));
    EXPECT_EQ(file.groups.at("physical volume 2"), (Soup_group{{}, {1}}));
    EXPECT_EQ(file.groups.at("inlet of A").facets.size(), 1u);
    const Numbers& sides = file.groups.at("middle").facets;  // of both cells
    ASSERT_EQ(sides.size(), 2u);
    for (const std::uint32_t f : sides) {
      Numbers corners(soup.facet(f).begin(), soup.facet(f).end());
      std::sort(corners.begin(), corners.end());
      EXPECT_EQ(corners, (Numbers{1, 2, 3}));
    }
    EXPECT_EQ(file.report.notes,
              (Notes{"1 point and line elements ignored",
                     "group \"inlet of A\": 1 polygons that are no facets of cells left out",
                     "group \"rim\": 1 lines and points left out"}));
  }
}

TEST(ElementGroups, InThePlaneLinesAreFacets) {
  const Mesh_file file = read_mesh(
      "t.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 4 \"in\"\n2 5 \"in\"\n$EndPhysicalNames\n"
      "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n4\n1 2 2 5 1 1 2 3\n"
      "2 2 2 0 1 1 3 4\n3 1 2 4 1 2 1\n4 1 2 4 1 1 3\n$EndElements\n");
  EXPECT_EQ(file.groups, (Soup_groups{{"in", {{0, 2, 3}, {0}}}}));
}

TEST(ElementGroups, OfSurfacesAreDroppedWithANote) {
  const Mesh_file file = read_mesh(
      "t.msh",
      with(with(version_2, "4 4 2 1 1 1 2 3 4\n5 4 2 2 1 2 4 3 5\n", ""), "$Elements\n6", "$Elements\n4"));
  EXPECT_TRUE(file.groups.empty());
  EXPECT_EQ(file.report.notes.back(), "3 groups ignored: a surface is meshed anew");
}

TEST(ElementGroups, ElementsOfSeveralGroupsAreReadOnce) {
  // As Gmsh writes version 2.2: an element once for each of its groups.
  std::string text = with(version_2, "4 4 2 1 1 1 2 3 4", "4 4 2 1 1 1 2 3 4\n7 4 2 9 1 1 2 3 4");
  text = with(text, "2 2 2 8 2 3 2 4\n", "2 2 2 8 2 3 2 4\n8 2 2 7 2 3 2 4\n9 2 2 6 2 3 2 4\n");
  const Mesh_file file = read_mesh("t.msh", with(text, "$Elements\n6", "$Elements\n9"));
  EXPECT_EQ(std::get<Cell_soup<3>>(file.mesh).cell_count(), 2u);
  EXPECT_EQ(file.groups.at("blood"), (Soup_group{{}, {0}}));
  EXPECT_EQ(file.groups.at("physical volume 9"), (Soup_group{{}, {0}}));
  EXPECT_EQ(file.groups.at("physical surface 6"), file.groups.at("middle"));
  EXPECT_EQ(file.groups.at("inlet of A").facets.size(), 3u);
  EXPECT_EQ(file.report.notes.front(),
            "3 elements repeated, once for each of their physical groups: read once");
  // Those of one group, or of none, are elements of their own.
  for (const char* tag : {"1", "0"}) {
    const std::string twice =
        with(version_2, "4 4 2 1 1 1 2 3 4", std::string("4 4 2 1 1 1 2 3 4\n7 4 2 ") + tag + " 1 1 2 3 4");
    const Mesh_file all = read_mesh("t.msh", with(twice, "$Elements\n6", "$Elements\n7"));
    EXPECT_EQ(std::get<Cell_soup<3>>(all.mesh).cell_count(), 3u);
  }
}

TEST(ElementGroups, LongNamesAreKept) {
  const std::string name = "a name of a group that has more than forty characters, with a part of its own";
  const Mesh_file file = read_mesh("t.msh", with(version_2, "\"blood\"", '"' + name + '"'));
  EXPECT_EQ(file.groups.count(name), 1u);
}

TEST(ElementGroups, NamesThatNoGroupCanHaveAreChanged) {
  const Mesh_file file = read_mesh("t.msh", with(version_2, "\"blood\"", "\"red \"x\" blood\""));
  EXPECT_EQ(file.groups.count("red 'x' blood"), 1u);
  EXPECT_NE(std::find(file.report.notes.begin(), file.report.notes.end(),
                      "group \"red \"x\" blood\" named \"red 'x' blood\""),
            file.report.notes.end());
}

TEST(ElementGroups, PartitionsAndGhostsAreTags) {
  const std::string partitioned = with(with(version_2, "4 4 2 1 1 1 2 3 4", "4 4 4 1 1 1 1 1 2 3 4"),
                                       "5 4 2 2 1 2 4 3 5", "5 4 5 2 1 2 2 -1 2 4 3 5");
  EXPECT_EQ(read_mesh("t.msh", partitioned).groups, read_mesh("t.msh", version_2).groups);
  // As Gmsh writes a mesh in partitions: the elements belong to entities of these.
  const std::string entities =
      "$PartitionedEntities\n2\n1\n9 1\n0 0 0 2\n1 3 1 1 1 0 0 0 1 1 1 1 1 0\n2 3 2 1 2 0 0 0 1 1 1 1 2 0\n"
      "$EndPartitionedEntities\n";
  const std::string with_entities =
      with(with(version_4_1, "$Nodes\n", entities + "$Nodes\n"),
           "1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n$EndE", "5 0 0 0 1 1 1 0 0\n6 0 0 0 1 1 1 0 0\n$EndE");
  EXPECT_EQ(read_mesh("t.msh", with_entities).groups, read_mesh("t.msh", version_4_1).groups);
}

TEST(ElementGroups, OfUnvAreRead) {
  std::string text = "    -1\n  2411\n";
  for (const std::string node : {"1 1 1 11\n 0.0D+00 0.0D+00 0.0D+00\n", "2 1 1 11\n 1.0D+00 0 0\n",
                                 "3 1 1 11\n 0 1.0D+00 0\n", "4 1 1 11\n 0 0 1.0D+00\n"})
    text += node;
  text +=
      "    -1\n    -1\n  2412\n 1 41 1 1 7 3\n 1 2 3\n 2 111 1 1 7 4\n 1 2 3 4\n 3 21 1 1 7 2\n 0 0 0\n 1 "
      "2\n    -1\n"
      "    -1\n  2467\n 1 0 0 0 0 0 0 1\nfloor\n 8 1 0 0\n 2 0 0 0 0 0 0 2\nfluid\n 8 2 0 0 7 1 0 0\n    "
      "-1\n";
  const Mesh_file file = read_mesh("t.unv", text);
  EXPECT_EQ(file.groups, (Soup_groups{{"floor", {{0}, {}}}, {"fluid", {{}, {0}}}}));
  EXPECT_EQ(file.report.notes, (Notes{"group \"fluid\": 1 entities that are no elements left out",
                                      "1 point and line elements ignored"}));
}

}  // namespace
}  // namespace cellwalk::io
