// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/frame_series.h>
#include <cellwalk/internal/io/vtu.h>

#include <gtest/gtest.h>

#include <limits>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

using Byte_list = std::vector<std::uint8_t>;

Cell_soup<3> two_cells() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},    {0, 0, 1},
                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}};
  add_hexahedron(soup, {0, 1, 2, 3, 4, 5, 6, 7});
  add_pyramid(soup, {4, 5, 6, 7, 8});
  return soup;
}

TEST(Vtu, CellsHaveTheirTypes) {
  Cell_soup<3> soup = two_cells();
  soup.points.push_back({3, 0, 0});
  soup.points.push_back({3, 1, 0});
  soup.points.push_back({3, 0, 1});
  add_tetrahedron(soup, 1, 9, 10, 11);
  soup.solid[2] = 1;
  add_prism(soup, {2, 10, 11, 3, 4, 5});
  soup.add_facet({0, 1, 2, 3, 4});  // a pyramid over a pentagon is a polyhedron
  for (std::uint32_t i = 0; i < 5; ++i) soup.add_facet({i, (i + 1) % 5, 8});
  soup.end_cell();
  const Vtu_grid grid = vtu_of_cells(soup);
  EXPECT_EQ(grid.types, (Byte_list{12, 14, 10, 13, 42}));
  EXPECT_EQ(grid.connectivity, (std::vector<std::int64_t>{0,  1,  2, 3,  4,  5, 6, 7, 4, 5, 6, 7, 8, 1, 9,
                                                          10, 11, 2, 11, 10, 3, 5, 4, 0, 1, 2, 3, 4, 8}));
  EXPECT_EQ(grid.offsets, (std::vector<std::int64_t>{8, 13, 17, 23, 29}));
  EXPECT_EQ(grid.face_offsets, (std::vector<std::int64_t>{-1, -1, -1, -1, 27}));
  EXPECT_EQ(std::get<1>(grid.cell_data[1].values), (std::vector<std::int64_t>{0, 0, 1, 0, 0}));
}

TEST(Vtu, FacetsMayBeInAnyOrder) {
  Cell_soup<3> soup;
  soup.points.resize(6);
  soup.add_facet({2, 0, 3, 5});
  soup.add_facet({0, 1, 4, 3});
  soup.add_facet({5, 3, 4});
  soup.add_facet({1, 2, 5, 4});
  soup.add_facet({0, 2, 1});
  soup.end_cell();
  soup.add_facet({0, 1, 4});
  soup.add_facet({1, 2, 4});
  soup.add_facet({0, 3, 2, 1});
  soup.add_facet({2, 3, 4});
  soup.add_facet({3, 0, 4});
  soup.end_cell();
  const Vtu_grid grid = vtu_of_cells(soup);
  EXPECT_EQ(grid.types, (Byte_list{13, 14}));
  EXPECT_EQ(grid.connectivity, (std::vector<std::int64_t>{5, 3, 4, 2, 0, 1, 0, 1, 2, 3, 4}));
}

TEST(Vtu, ACellOfSixQuadsThatIsNoHexahedronStaysAPolyhedron) {
  Cell_soup<3> soup;
  soup.points.resize(8);
  add_hexahedron(soup, {0, 1, 2, 3, 4, 5, 6, 7});
  soup.vertices[4] = 0;  // the top now shares a corner with the base
  EXPECT_EQ(vtu_of_cells(soup).types, (Byte_list{42}));
}

TEST(Vtu, WallsAreTheBoundaryAndTheImpassableFacetsOnce) {
  Cell_soup<3> soup = two_cells();
  EXPECT_EQ(vtu_of_walls(soup).types, (Byte_list{9, 9, 9, 9, 9, 5, 5, 5, 5}));
  soup.impassable[1] = 1;  // between the two cells, said by one of them
  const Vtu_grid walls = vtu_of_walls(soup);
  EXPECT_EQ(walls.cell_count(), 10u);
  EXPECT_EQ(std::get<1>(walls.cell_data[0].values),
            (std::vector<std::int64_t>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1}));
  soup.impassable[1] = 0;
  soup.solid[1] = 1;  // tissue beside it: the walls of the first cell are left, the one between them too
  EXPECT_EQ(vtu_of_walls(soup).types, (Byte_list{9, 9, 9, 9, 9, 9}));
  soup.solid[0] = 1;
  EXPECT_EQ(vtu_of_walls(soup).cell_count(), 0u);
  Cell_soup<2> plane;
  plane.points = {{0, 0}, {1, 0}, {0, 1}};
  add_polygon(plane, std::vector<std::uint32_t>{0, 1, 2});
  EXPECT_EQ(vtu_of_walls(plane).types, (Byte_list{3, 3, 3}));
  EXPECT_EQ(vtu_of_cells(plane).types, (Byte_list{5}));
}

TEST(Vtu, TextCanBeRead) {
  Vtu_grid grid;
  grid.points = {{0, 0.1, -0.0}, {1e300, 5e-324, 3}};
  grid.add_cell(Vtu_cell::polyline, std::vector<std::uint32_t>{0, 1});
  grid.point_data = {{"a<b", 1, std::vector<double>{1, 2}}};
  EXPECT_EQ(
      vtu_text(grid, Vtu_encoding::text),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"2\" NumberOfCells=\"1\">\n<Points>\n"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n"
      "0 0.1 -0\n1e+300 5e-324 3\n</DataArray>\n</Points>\n<Cells>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" NumberOfComponents=\"1\" "
      "format=\"ascii\">\n0\n1\n</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" NumberOfComponents=\"1\" "
      "format=\"ascii\">\n2\n</DataArray>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" NumberOfComponents=\"1\" format=\"ascii\">\n4\n</DataArray>\n"
      "</Cells>\n<PointData>\n"
      "<DataArray type=\"Float64\" Name=\"a&lt;b\" NumberOfComponents=\"1\" "
      "format=\"ascii\">\n1\n2\n</DataArray>\n"
      "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

TEST(Vtu, Base64IsThatOfTheStandard) {
  Vtu_grid grid;  // three points: 72 bytes of zeros, and their number before them
  grid.points.assign(3, {0, 0, 0});
  EXPECT_NE(vtu_text(grid).find("\nSAAAAAAAAAA=" + std::string(96, 'A') + "\n"), std::string::npos);
}

TEST(Vtu, ArraysMustFit) {
  Vtu_grid grid;
  grid.points = {{0, 0, 0}};
  grid.point_data = {{"v", 3, std::vector<double>{1, 2}}};
  EXPECT_EQ(refusal([&] { vtu_text(grid); }, Error_code::usage),
            "the array 'v' has 2 values, for 1 times 3 components");
}

TEST(FrameSeries, AppearsOnCommitInThePlaceOfAnEarlierOne) {
  const Folder folder;
  const auto run = folder / "out" / "run.pvd";
  Vtu_grid grid;
  grid.points = {{0, 0, 0}};
  grid.add_cell(Vtu_cell::vertex, std::vector<std::uint32_t>{0});
  for (int frames : {3, 2}) {
    Frame_series series(run);
    for (int i = 0; i < frames; ++i) {
      series.add(0.5 * i, "particles", grid);
      series.add(0.5 * i, "contacts", grid);
    }
    EXPECT_EQ(std::filesystem::exists(run), frames == 2);
    series.commit();
    std::vector<std::string> names;
    for (const auto& e : std::filesystem::directory_iterator(folder / "out" / "frames"))
      names.push_back(e.path().filename());
    EXPECT_EQ(names.size(), 2u * static_cast<unsigned>(frames));
  }
  EXPECT_EQ(content_of(run),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n<Collection>\n"
            "<DataSet timestep=\"0\" group=\"\" part=\"1\" file=\"frames/particles_00000.vtu\"/>\n"
            "<DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"frames/contacts_00000.vtu\"/>\n"
            "<DataSet timestep=\"0.5\" group=\"\" part=\"1\" file=\"frames/particles_00001.vtu\"/>\n"
            "<DataSet timestep=\"0.5\" group=\"\" part=\"0\" file=\"frames/contacts_00001.vtu\"/>\n"
            "</Collection>\n</VTKFile>\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "out"), {}), 2);
}

TEST(FrameSeries, LeavesNothingBehindWithoutCommit) {
  const Folder folder;
  {
    Frame_series series(folder / "a" / "b" / "run.pvd");
    series.add(0, "particles", {});
    EXPECT_TRUE(std::filesystem::exists(folder / "a" / "b"));
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(FrameSeries, DoesNotReplaceWhatIsNotItsOwn) {
  const Folder folder;
  std::filesystem::create_directories(folder / "frames");
  folder.write("frames/thesis.tex", "x");
  EXPECT_EQ(refusal([&] { Frame_series series(folder / "run.pvd"); }, Error_code::usage),
            (folder / "frames/thesis.tex").string() +
                ": is no frame, and its folder would be replaced: move it, or write to another folder");
  EXPECT_EQ(content_of(folder / "frames/thesis.tex"), "x");
}

}  // namespace
}  // namespace cellwalk::io
