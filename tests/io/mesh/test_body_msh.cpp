// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies from .msh: lines, surfaces and volumes.
#include <cellwalk/io/body_file.h>

#include <gtest/gtest.h>

#include "io/io_fixture.h"
#include "records/body_checks.h"

namespace cellwalk::io {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;
using Notes = std::vector<std::string>;

std::string msh(const std::string& nodes, const std::string& elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes + "$EndNodes\n$Elements\n" + elements +
         "$EndElements\n";
}

template <int D>
Body_file<D> read(const std::string& text) {
  const Folder folder;
  Body_file<D> file = read_body<D>(folder.write("b.msh", text));
  EXPECT_EQ(test::flaw(file.body), "");
  return file;
}

const std::string body_square = "4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n";

TEST(BodyMsh, ReadsLines) {
  // A point, a line of first order, one of second order (with its middle node last), and a further line.
  const std::string text =
      msh(body_square, "4\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 8 2 0 2 2 4 3\n4 1 2 0 1 4 1\n");
  const auto file = read<3>(text);
  EXPECT_EQ(file.body.edges, (Edges{{0, 1}, {0, 3}, {1, 3}}));
  EXPECT_TRUE(file.body.faces.empty());
  EXPECT_EQ(file.report.notes, (Notes{"1 point elements ignored",
                                      "1 elements of higher order read by their corner nodes, as straight",
                                      "1 vertices on no edge"}));
  EXPECT_EQ(read<2>(text).body.edges, file.body.edges);
}

TEST(BodyMsh, ReadsSurfacesWithTheirLines) {
  const std::string text = msh("5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 3 3 0\n",
                               "3\n1 3 2 0 1 1 2 3 4\n2 1 2 0 1 1 2\n3 1 2 0 1 3 5\n");
  EXPECT_EQ(read<3>(text).body.edges, (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {2, 4}}));
  EXPECT_EQ(read<3>(text).body.faces.size(), 2u);
  EXPECT_EQ(read<2>(text).body.edges, (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}, {2, 4}}));
}

TEST(BodyMsh, ReadsVolumesWithAllTheirEdgesAndFacets) {
  // Two cubes on each other: 12 vertices, 20 edges, 11 squares, each with a diagonal.
  const auto file = read<3>(msh(
      "12\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 0 0 2\n10 1 0 2\n11 1 1 "
      "2\n12 0 1 2\n",
      "3\n1 3 2 0 1 1 2 3 4\n2 5 2 0 1 1 2 3 4 5 6 7 8\n3 5 2 0 1 6 7 8 5 10 11 12 9\n"));
  EXPECT_EQ(file.body.points.size(), 12u);
  EXPECT_EQ(file.body.faces.size(), 22u);
  EXPECT_EQ(file.body.edges.size(), 31u);
  EXPECT_EQ(file.report.notes, (Notes{"13 polygons cut into triangles: the diagonals are edges"}));
  EXPECT_EQ(file.report.cells, 0u);
}

TEST(BodyMsh, RefusesAHeightInThePlane) {
  const Folder folder;
  const auto path = folder.write("b.msh", msh("2\n1 0 0 0\n2 1 0 3\n", "1\n1 1 2 0 1 1 2\n"));
  EXPECT_EQ(refusal([&] { read_body<2>(path); }),
            path.string() + ": vertex 1: z is 3, in a 2D body: make every z zero, or use it in 3D");
}

TEST(BodyMsh, LeavesLinesOutOfMeshes) {
  const Folder folder;
  const auto path = folder.write("b.msh", msh(body_square, "2\n1 3 2 0 1 1 2 3 4\n2 1 2 0 1 1 2\n"));
  EXPECT_EQ(read_mesh(path).report.notes,
            (Notes{"1 point and line elements ignored", "every z is zero: the polygons are 2D cells"}));
}

}  // namespace
}  // namespace cellwalk::io
