// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled where Gmsh is there: it writes the files that are read.
#include <cellwalk/io/mesh_file.h>

#include <gmsh.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <numeric>

#include "io/io_fixture.h"
#include "volumes.h"

namespace cellwalk::io {
namespace {

// A hexahedron, a prism beside it, a pyramid on it, and a tetrahedron beside that; a square, a line and a
// point.
const std::string nodes =
    "12\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n10 2 0 1\n11 0 0 "
    "2\n12 -1 0 1\n";
const std::string msh_2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes +
    "$EndNodes\n$Elements\n7\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 3 2 0 1 1 2 3 4\n"
    "4 5 2 0 1 1 2 3 4 5 6 7 8\n5 6 2 0 1 2 9 3 6 10 7\n6 7 2 0 1 5 6 7 8 11\n7 4 2 0 1 5 11 8 12\n"
    "$EndElements\n";
const std::string msh_1 =
    "$NOD\n" + nodes +
    "$ENDNOD\n$ELM\n4\n1 5 0 1 8 1 2 3 4 5 6 7 8\n2 6 0 1 6 2 9 3 6 10 7\n3 7 0 1 5 5 6 7 8 11\n"
    "4 4 0 1 4 5 11 8 12\n$ENDELM\n";
const std::vector<double> volumes{6, 3, 2, 1};  // sixths, in the order of the elements

Mesh_file read(const std::string& name, const std::string& text) {
  const Folder folder;
  return read_mesh(folder.write(name, text));
}

enum class Order { of_the_file, any };

void expect_the_cells(const Mesh_file& file, const std::string& format, Order order = Order::of_the_file) {
  EXPECT_EQ(file.report.format, format);
  const auto& soup = std::get<Cell_soup<3>>(file.mesh);
  EXPECT_EQ(soup.points.size(), 12u);
  std::vector<double> found = six_volumes(soup);
  if (order == Order::any) std::sort(found.rbegin(), found.rend());
  EXPECT_EQ(found, volumes);
  EXPECT_TRUE(all_closed(soup));
  EXPECT_EQ(shared_facets(soup), 3u);
}

/// The mesh above as Gmsh itself writes it.
std::string written_by_gmsh(const std::string& extension, double version = 2.2, bool binary = false) {
  const Folder folder;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open(folder.write("in.msh", msh_2).string());
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::write((folder / ("out" + extension)).string());
  gmsh::finalize();
  return content_of(folder / ("out" + extension));
}

TEST(Gmsh, TextOfEveryVersionIsRead) {
  expect_the_cells(read("t.msh", msh_1), "Gmsh 1");
  const Mesh_file file = read("t.msh", msh_2);
  expect_the_cells(file, "Gmsh 2.2");
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"2 point and line elements ignored",
                                                         "1 polygons beside the volume cells ignored"}));
  expect_the_cells(read("t.msh", written_by_gmsh(".msh", 4.0)), "Gmsh 4");
  expect_the_cells(read("t.msh", written_by_gmsh(".msh", 4.1)), "Gmsh 4.1");
}

TEST(Gmsh, BinaryOfEveryVersionIsRead) {
  expect_the_cells(read("t.msh", written_by_gmsh(".msh", 2.2, true)), "Gmsh 2.2 (binary)", Order::any);
  expect_the_cells(read("t.msh", written_by_gmsh(".msh", 4.1, true)), "Gmsh 4.1 (binary)");
}

/// A box of which the faces x = 0 and x = 1 are in two groups and one of them, and the volume in two; or its
/// base alone, with the curve y = 0. As Gmsh writes it.
std::string box_with_groups(int dimension, double version, bool binary) {
  const Folder folder;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  using Entities = std::vector<std::pair<int, int>>;
  if (dimension == 3)
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  else
    gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
  gmsh::model::occ::synchronize();
  const auto at = [dimension](double x, double y, double z, double dx, double dy, double dz) {
    Entities found;
    gmsh::model::getEntitiesInBoundingBox(x - .1, y - .1, z - .1, x + dx + .1, y + dy + .1, z + dz + .1,
                                          found, dimension - 1);
    return found.at(0).second;
  };
  const double depth = dimension == 3 ? 1 : 0;
  const int low = at(0, 0, 0, 0, 1, depth), high = at(1, 0, 0, 0, 1, depth);
  const auto group = [](int of, const std::vector<int>& tags, const std::string& name) {
    gmsh::model::setPhysicalName(of, gmsh::model::addPhysicalGroup(of, tags), name);
  };
  group(dimension, {1}, "blood");
  group(dimension, {1}, "all that is within the walls, a name of many letters");
  group(dimension - 1, {low, high}, "ends");
  group(dimension - 1, {low}, "inlet");
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  gmsh::model::mesh::generate(dimension);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::write((folder / "out.msh").string());
  gmsh::finalize();
  return content_of(folder / "out.msh");
}

template <int D>
void expect_groups(const Mesh_file& file) {
  const auto& soup = std::get<Cell_soup<D>>(file.mesh);
  std::vector<std::uint32_t> all(soup.cell_count());
  std::iota(all.begin(), all.end(), 0u);
  ASSERT_EQ(file.groups.size(), 4u);
  EXPECT_EQ(file.groups.at("blood").cells, all);
  EXPECT_EQ(file.groups.at("all that is within the walls, a name of many letters").cells, all);
  std::vector<std::uint32_t> low, ends;
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f)
    for (const double x : {0., 1.}) {
      const auto loop = soup.facet(f);
      if (!std::ranges::all_of(loop, [&](std::uint32_t v) { return soup.points[v][0] == x; })) continue;
      ends.push_back(f);
      if (x == 0) low.push_back(f);
    }
  EXPECT_GE(low.size(), 2u);
  EXPECT_EQ(file.groups.at("inlet").facets, low);
  EXPECT_EQ(file.groups.at("ends").facets, ends);
}

TEST(Gmsh, PhysicalGroupsComeThrough) {
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true}) {
      SCOPED_TRACE(testing::Message() << version << (binary ? " binary" : ""));
      expect_groups<3>(read("t.msh", box_with_groups(3, version, binary)));
      expect_groups<2>(read("t.msh", box_with_groups(2, version, binary)));
    }
}

TEST(Gmsh, MeditIsRead) {
  const Mesh_file file =
      read("t.mesh", written_by_gmsh(".mesh"));  // Gmsh writes no prisms and pyramids there
  EXPECT_EQ(file.report.format, "MEDIT");
  const auto& soup = std::get<Cell_soup<3>>(file.mesh);
  EXPECT_TRUE(all_closed(soup));
  EXPECT_EQ(six_volumes(soup), (std::vector<double>{1, 6}));
}

TEST(Gmsh, UnvIsRead) {
  const Mesh_file file = read("t.unv", written_by_gmsh(".unv"));  // Gmsh writes no pyramids there
  EXPECT_EQ(file.report.format, "UNV");
  const auto& soup = std::get<Cell_soup<3>>(file.mesh);
  EXPECT_TRUE(all_closed(soup));
  EXPECT_EQ(six_volumes(soup), (std::vector<double>{6, 3, 1}));
}

TEST(Gmsh, CompressedFilesAreRead) {
  const Folder folder;
  gzFile out = gzopen((folder / "t.msh.gz").c_str(), "wb");
  gzwrite(out, msh_2.data(), static_cast<unsigned>(msh_2.size()));
  gzclose(out);
  expect_the_cells(read_mesh(folder / "t.msh.gz"), "Gmsh 2.2");
}

TEST(Gmsh, ElementsOfSecondOrderAreReadByTheirCorners) {
  const Mesh_file file =
      read("t.msh",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
           "5 0.5 0 0\n6 0.5 0.5 0\n7 0 0.5 0\n8 0 0 0.5\n9 0 0.5 0.5\n10 0.5 0 0.5\n$EndNodes\n"
           "$Elements\n1\n1 11 2 0 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n");
  EXPECT_EQ(six_volumes(std::get<Cell_soup<3>>(file.mesh)), (std::vector<double>{1}));
  EXPECT_EQ(file.report.notes,
            (std::vector<std::string>{"1 elements of higher order read by their corner nodes, as straight"}));
}

TEST(Gmsh, FlatAndSurfaceMeshesAreReadToo) {
  const std::string flat =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
      "$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n";
  EXPECT_EQ(std::get<Cell_soup<2>>(read("t.msh", flat).mesh).cell_count(), 2u);
  const Mesh_file bent = read("t.msh", with(flat, "4 0 1 0", "4 0 1 1"));
  EXPECT_EQ(std::get<Surface_soup>(bent.mesh).facets,
            (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Gmsh, NumbersThatRepeatLoseNoElement) {
  const Mesh_file file = read("t.msh", with(msh_2, "\n6 7 2", "\n5 7 2"));
  expect_the_cells(file, "Gmsh 2.2");
  EXPECT_EQ(file.report.notes.front(), "numbers of elements repeat: the elements were numbered anew");
  expect_the_cells(read("t.msh", with(written_by_gmsh(".msh", 4.1), "\n6 5 6 7 8 11", "\n5 5 6 7 8 11")),
                   "Gmsh 4.1", Order::any);
}

TEST(Gmsh, NodesThatBelongToNoElementAreCounted) {
  const Mesh_file file = read("t.msh", with(msh_2, "12\n1 0", "13\n99 7 7 7\n1 0"));
  EXPECT_EQ(file.report.notes.front(), "1 nodes that belong to no element left out");
}

TEST(Gmsh, BrokenFilesAreRefusedWithAReason) {
  struct Case {
    std::string text, message;
  };
  const Case cases[] = {
      {"$MeshFormat\n9.9 0 8\n$EndMeshFormat\n",
       "t.msh: version 9.9 of .msh is not read: 1, 2, 4.0 and 4.1 are"},
      {"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "holds neither volume cells nor polygons"},
      {with(msh_2, "$Elements\n7", "$Elements\n9"), "an element: '$EndElements' is not an integer"},
      {with(written_by_gmsh(".msh", 4.1), "\n7 7 1 7\n", "\n7 8 1 8\n"),
       "t.msh:57: the section announces 8 elements, and its blocks hold 7"},
      {with(msh_2, "3 1 1 0", "3 1 nan 0"), "t.msh:8: a coordinate: 'nan' is not finite"},
      {"$Shell\n", ":1: not a mesh of Gmsh: it begins with '$Shell'"},
      {"$MeshFormat\n", ":2: the file ends where the version of the format should be: it is cut short"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    const std::string why = refusal([&] { read("t.msh", c.text); });
    EXPECT_NE(why.find(c.message), std::string::npos) << why;
  }
}

TEST(Gmsh, TruncatedFilesNeverCrash) {
  const auto count = [](const std::string& name, const std::string& text) {
    return refused_truncations(text, [&](const std::string& t) { read(name, t); });
  };
  EXPECT_GE(count("t.msh", msh_1), 18);
  EXPECT_GE(count("t.msh", msh_2), 18);
  EXPECT_GE(count("t.msh", written_by_gmsh(".msh", 4.1)), 18);
  EXPECT_GE(count("t.msh", written_by_gmsh(".msh", 2.2, true)), 18);
  EXPECT_GE(count("t.msh", written_by_gmsh(".msh", 4.1, true)), 18);
  EXPECT_GE(count("t.mesh", written_by_gmsh(".mesh")), 10);
  EXPECT_GE(count("t.unv", written_by_gmsh(".unv")), 10);
}

}  // namespace
}  // namespace cellwalk::io
