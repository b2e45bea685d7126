// SPDX-License-Identifier: LGPL-3.0-or-later
// .msh of every version: what is there is read, and what is not there is refused with its place.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>

#include "io/damaged.h"
#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

const std::string points = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const std::string version_1 = "$NOD\n4\n" + points + "$ENDNOD\n$ELM\n1\n1 4 1 1 4 1 2 3 4\n$ENDELM\n";
const std::string version_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n" + points +
                              "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
const std::string version_4_0 =
    "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n1 4\n1 "
    "3 0 4\n" +
    points + "$EndNodes\n$Elements\n1 1\n1 3 4 1\n1 1 2 3 4\n$EndElements\n";
const std::string version_4_1 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

Mesh_file read(const std::string& text) { return read_mesh("t.msh", text); }

std::string why(const std::string& text) {
  return refusal([&] { read(text); });
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Msh, WhatIsThereIsRead) {
  for (const std::string& text : {version_1, version_2, version_4_0, version_4_1}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(read(text).report.cells, 1u);
  }
}

TEST(Msh, ElementsThatNameNodesThatAreNotThereAreRefused) {
  for (const std::string& text : {version_1, version_2, version_4_0, version_4_1})
    for (const std::string node : {"5", "77", "0", "-7", "99999999999", "99999999999999999999999"}) {
      const std::string said = why(with(text, "1 2 3 4\n$E", "1 2 3 " + node + "\n$E"));
      EXPECT_TRUE(holds(said, ": element 1 names node ") && holds(said, ", which does not exist")) << said;
    }
}

TEST(Msh, TagsHaveAtMost32Bits) {
  int refused = 0;
  for (const std::string tag :
       {"-9223372036854775808", "9223372036854775807", "-2147483649", "2147483648", "99999999999999999999"}) {
    for (const std::string& text :
         {with(version_1, "1 4 1 1 4", "1 4 TAG 1 4"), with(version_2, "1 4 2 1 1", "1 4 2 TAG 1"),
          with(version_2, "1 4 2 1 1", "1 4 TAG 1 1"), with(version_4_0, "1 1 1 0 0\n", "1 1 1 1 TAG 0\n")}) {
      const std::string said = why(with(text, "TAG", tag));
      EXPECT_TRUE(holds(said, "needs more than 32 bits")) << said;
      ++refused;
    }
  }
  EXPECT_EQ(refused, 20);
  EXPECT_EQ(read(with(version_2, "1 4 2 1 1", "1 4 2 -2147483648 1")).groups.size(), 1u);
}

// An entity with many groups and many elements would take the memory of their product.
TEST(Msh, ElementsInMoreGroupsThanTheFileHasRoomForAreRefused) {
  const auto with_groups = [](int groups, int elements) {
    std::string tags, members;
    for (int i = 1; i <= groups; ++i) tags.append(" ").append(std::to_string(i));
    for (int i = 0; i < elements; ++i) members.append(std::to_string(i + 1)).append(" 1 2 3 4\n");
    const std::string in_groups =
        with(with(version_4_0, "1 1 1 0 0\n", "1 1 1 GROUPS 0\n"), "GROUPS", std::to_string(groups) + tags);
    const std::string count = std::to_string(elements);
    return with(with(with(in_groups, "1 1\n1 3 4 1\n", "1 COUNT\n1 3 4 COUNT\n"), "COUNT", count),
                "COUNT\n1 1 2 3 4\n", count + "\n" + members);
  };
  EXPECT_EQ(read(with_groups(20, 3)).groups.size(), 20u);
  EXPECT_TRUE(
      holds(why(with_groups(5000, 50'000)), "more groups than a mesh of this size has: it is broken"));
}

TEST(Msh, NumbersMayHaveGapsAndAnyOrder) {
  const std::string gaps =
      with(with(version_2, "4 0 0 1\n", "9000000 0 0 1\n"), "1 2 3 4\n", "1 2 3 9000000\n");
  EXPECT_EQ(read(gaps).report.cells, 1u);
  EXPECT_TRUE(holds(why(with(gaps, "1 2 3 9000000\n", "1 2 3 4\n")),
                    "t.msh:13: element 1 names node 4, which does not exist"));
  EXPECT_EQ(read(with(version_2, points, "3 0 1 0\n1 0 0 0\n4 0 0 1\n2 1 0 0\n")).report.cells, 1u);
}

TEST(Msh, LinesMayEndAnywhere) {
  const std::string spread = with(version_2, "1 4 2 1 1 1 2 3 4\n", "1 4\n2 1 1\n1 2 3\n4\n");
  EXPECT_EQ(read(spread).report.cells, 1u);
  EXPECT_TRUE(holds(why(with(spread, "1 2 3\n4\n", "1 2 3\n5\n")),
                    ":16: element 1 names node 5, which does not exist"));
}

TEST(Msh, ElementsOfHighOrderNameNodesToo) {
  // Type 36 is a quadrilateral of 16 nodes.
  const std::string other =
      with(version_2, "1\n1 4 2 1 1 1 2 3 4\n", "1\n1 36 2 1 1 1 2 3 4 1 2 3 4 1 2 3 4 1 2 3 8\n");
  EXPECT_TRUE(holds(why(other), "element 1 names node 8, which does not exist"));
}

TEST(Msh, SectionsThatHoldOtherNumbersThanTheyAnnounceAreRefused) {
  EXPECT_TRUE(holds(why(with(version_4_1, "1 4 1 4\n3 1 0 4\n", "1 3 1 4\n3 1 0 4\n")),
                    ":14: the section announces 3 nodes, and its blocks hold 4"));
  EXPECT_TRUE(holds(why(with(version_4_1, "1 1 1 1\n", "1 0 1 1\n")),
                    ": the section announces 0 elements, and its blocks hold 1"));
  EXPECT_TRUE(
      holds(why(version_2 + "$Nodes\n0\n$EndNodes\n"), "t.msh:15: the section '$Nodes' occurs twice"));
  EXPECT_TRUE(
      holds(why(with(version_4_1, "\n1\n2\n3\n4\n", "\n1\n2\n3\n-4\n")), ":10: -4 is no number of a node"));
  EXPECT_TRUE(holds(why(with(version_2, "4 0 0 1\n", "4294967300 0 0 1\n")),
                    ":9: 4294967300 is no number of a node"));
}

/// Numbers as they lie in memory.
template <class T>
std::string raw(std::initializer_list<T> values, bool swap = false) {
  std::string bytes;
  for (const T value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (swap) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

const std::initializer_list<double> corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string binary_2(std::int32_t node, bool swap = false) {
  std::string text =
      "$MeshFormat\n2.2 1 8\n" + raw<std::int32_t>({1}, swap) + "\n$EndMeshFormat\n$Nodes\n4\n";
  for (std::int32_t i = 0; i < 4; ++i)
    text += raw<std::int32_t>({i + 1}, swap) + raw<double>(corners[i], swap);
  return text + "\n$EndNodes\n$Elements\n1\n" + raw<std::int32_t>({4, 1, 2, 1, 1, 1, 1, 2, 3, node}, swap) +
         "\n$EndElements\n";
}

std::string binary_4_1(std::int64_t node, std::int64_t announced = 4) {
  std::string text = "$MeshFormat\n4.1 1 8\n" + raw<std::int32_t>({1}) + "\n$EndMeshFormat\n$Nodes\n" +
                     raw<std::int64_t>({1, announced, 1, 4}) + raw<std::int32_t>({3, 1, 0}) +
                     raw<std::int64_t>({4, 1, 2, 3, 4});
  for (const auto& corner : corners) text += raw<double>(corner);
  return text + "\n$EndNodes\n$Elements\n" + raw<std::int64_t>({1, 1, 1, 1}) + raw<std::int32_t>({3, 1, 4}) +
         raw<std::int64_t>({1, 1, 1, 2, 3, node}) + "\n$EndElements\n";
}

TEST(Msh, BinaryFilesAreReadToo) {
  for (const std::string& fine : {binary_2(4), binary_2(4, true), binary_4_1(4)})
    EXPECT_EQ(read(fine).report.cells, 1u);
  for (const std::int32_t node : {5, 77, 0, -7, 99999999})
    for (const std::string& text : {binary_2(node), binary_2(node, true), binary_4_1(node)})
      EXPECT_TRUE(holds(why(text), "t.msh: element 1 names node ") &&
                  holds(why(text), ", which does not exist"))
          << why(text);
  EXPECT_TRUE(holds(why(binary_4_1(4, 3)), "t.msh: the section announces 3 nodes, and its blocks hold 4"));
  EXPECT_TRUE(holds(why(with(binary_2(4), raw<std::int32_t>({4, 1, 2}), raw<std::int32_t>({70, 1, 2}))),
                    "t.msh: elements of type 70 are not read"));
  EXPECT_TRUE(holds(why(with(binary_2(4), raw<std::int32_t>({4, 1, 2}), raw<std::int32_t>({4, 2, 2}))),
                    "t.msh: a block of 2 elements, where 1 are left"));
  EXPECT_TRUE(holds(why(with(binary_2(4), "$Nodes", "$ParametricNodes")),
                    "binary nodes with parameters are not read"));
  EXPECT_TRUE(holds(why(binary_2(4) + "$Nodes\n0\n$EndNodes\n"), "the section '$Nodes' occurs twice"));
}

TEST(Msh, UnvWithNegativeNodesIsRefused) {
  const auto unv = [](const std::string& node) {
    std::string text = "    -1\n  2411\n";
    for (int i = 0; i < 4; ++i) {
      text += "         " + std::to_string(i + 1) + "         1         1        11\n";
      for (int axis = 0; axis < 3; ++axis) text += i == axis + 1 ? "   1.0E+00" : "  -0.0E+00";
      text += "\n";
    }
    return text + "    -1\n    -1\n  2412\n         1       111         1         1         7         4\n" +
           "         1         2         3" + node + "\n    -1\n";
  };
  const auto read_unv = [](const std::string& text) {
    const Folder folder;
    return read_mesh(folder.write("t.unv", text));
  };
  EXPECT_EQ(read_unv(unv("         4")).report.cells, 1u);
  EXPECT_TRUE(holds(refusal([&] { read_unv(unv("        -7")); }),
                    "t.unv:15: element 1 names node -7, which does not exist"));
  EXPECT_TRUE(holds(refusal([&] { read_unv(unv("         5")); }),
                    "t.unv:15: element 1 names node 5, which does not exist"));
}

TEST(Msh, AnnouncedCountsAreCompared) {
  EXPECT_TRUE(holds(why(with(version_1, "$NOD\n4\n", "$NOD\n4000000000\n")),
                    ":7: a node: '$ENDNOD' is not an integer"));
  EXPECT_TRUE(holds(why(with(version_2, "$Nodes\n4\n", "$Nodes\n4000000000\n")),
                    ":10: a node: '$EndNodes' is not an integer"));
  EXPECT_TRUE(holds(why(with(version_4_1, "1 4 1 4\n", "1 4000000000 1 4\n")),
                    ":14: the section announces 4000000000 nodes, and its blocks hold 4"));
  EXPECT_TRUE(holds(why(with(version_4_0, "$Nodes\n1 4\n", "$Nodes\n1 4000000000\n")),
                    ": the section announces 4000000000 nodes, and its blocks hold 4"));
  EXPECT_TRUE(holds(why(binary_4_1(4, 4'000'000'000)),
                    "t.msh: the section announces 4000000000 nodes, and its blocks hold 4"));
}

TEST(Msh, WhatIsWrittenOtherwiseIsRefused) {
  EXPECT_TRUE(holds(why(with(version_4_1, "$Nodes\n", "$NodesH")),
                    ":4: text follows '$NodesH1', where the line should end"));
  EXPECT_TRUE(holds(why(with(version_4_1, "$Nodes\n", "$Nodes ")),
                    ":4: text follows '$Nodes', where the line should end"));
  EXPECT_TRUE(holds(why(with(binary_4_1(4), "$Elements\n", "$Elements 1\n")),
                    "text follows '$Elements', where the line"));
  EXPECT_TRUE(
      holds(why(with(version_2, "2 1 0 0\n", "2 1 0.5-3 0\n")), ":7: a coordinate: '0.5-3' is not a number"));
  EXPECT_TRUE(holds(why(with(version_2, "2 1 0 0\n", "2.5 1 0 0\n")), ":7: a node: '2.5' is not an integer"));
  const std::string binary = binary_4_1(4);
  EXPECT_TRUE(holds(why(with(binary, "$EndMeshFormat", "$(EndMeshFormat")),
                    "t.msh: the section '$MeshFormat' has no end"));
  EXPECT_TRUE(holds(why(binary.substr(0, binary.find("$EndNodes") - 9)),
                    "t.msh: the file ends inside its nodes or elements"));
}

TEST(Msh, DamagedFilesNeverCrash) {
  std::mt19937 random(7);
  int was_read = 0, was_refused = 0;
  const std::string files[] = {version_1, version_2, version_4_0, version_4_1, binary_2(4), binary_4_1(4)};
  for (int i = 0; i < 1200; ++i) {
    try {
      read(damaged(files[i % 6], random));
      ++was_read;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input) << error.what();
      ++was_refused;
    }
  }
  EXPECT_GT(was_read, 50);
  EXPECT_GT(was_refused, 300);
}

}  // namespace
}  // namespace cellwalk::io
