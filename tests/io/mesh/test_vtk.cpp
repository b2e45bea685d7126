// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled where VTK is there. Its readers judge what is written; its writers make what is read.
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "io/io_fixture.h"
#include "vtk_files.h"

namespace cellwalk::io {
namespace {

TEST(VtkReader, LegacyFilesAreReadInEveryOrderOfCorners) {
  const Mesh_file file = read("t.vtk", legacy());
  expect_the_cells(file);
  EXPECT_EQ(file.report.format, "VTK legacy 2.0");
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"1 point and line cells ignored",
                                                         "1 polygons beside the volume cells ignored"}));
}

TEST(VtkReader, TheLibrarysOwnFilesAreRead) {
  const auto grid = the_cells();
  using Legacy = vtkUnstructuredGridWriter;
  using Xml = vtkXMLUnstructuredGridWriter;
  const std::string modern = written<Legacy>(grid);
  EXPECT_NE(modern.find("Version 5.1"), std::string::npos);
  expect_the_cells(read("t.vtk", modern));
  expect_the_cells(read("t.vtk", written<Legacy>(grid, [](Legacy& w) { w.SetFileTypeToBinary(); })));
  expect_the_cells(read("t.vtk", written<Legacy>(grid, [](Legacy& w) {
                          w.SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
                        })));
  expect_the_cells(read("t.vtu", written<Xml>(grid, [](Xml& w) { w.SetDataModeToAscii(); })));
  expect_the_cells(read("t.vtu", written<Xml>(grid, [](Xml& w) { w.SetDataModeToBinary(); })));
  expect_the_cells(read("t.vtu", written<Xml>(grid, [](Xml& w) { w.SetDataModeToAppended(); })));
  expect_the_cells(read("t.vtu", written<Xml>(grid, [](Xml& w) {
                          w.SetDataModeToAppended();
                          w.SetEncodeAppendedData(0);
                          w.SetHeaderTypeToUInt64();
                        })));
  const Mesh_file hidden = read("t.vtk", written<Xml>(grid));
  expect_the_cells(hidden);
  EXPECT_EQ(hidden.report.notes.back(),
            "the extension says VTK legacy, the content VTK XML: read by its content");
}

TEST(VtkReader, WedgesInTheOtherOrderAreTurnedWhereOtherCellsTell) {
  const std::string other = with(legacy(), "6 1 2 8 5 6 9", "6 1 8 2 5 9 6");
  const Mesh_file file = read("t.vtk", other);
  expect_the_cells(file);
  EXPECT_EQ(file.report.notes.front(), "1 wedges follow the order of corners opposite to VTK's: read so");
  // All cells inverted, wedges too: one convention throughout, flipped when the environment is built.
  const auto inverted = grid_of({{VTK_WEDGE, {1, 8, 2, 5, 9, 6}}, {VTK_TETRA, {4, 7, 10, 11}}});
  EXPECT_EQ(six_volumes(volumes_of(read("t.vtu", written<vtkXMLUnstructuredGridWriter>(inverted)))),
            (std::vector<double>{-3, -1}));
}

TEST(VtkReader, CollapsedCellsAreReadAsWhatTheyAre) {
  // Each cell as a hexahedron, then as a wedge or a pyramid in the order of VTK.
  for (const auto& [cells, types] :
       {std::pair{"8 0 1 2 3 4 5 6 7\n8 1 8 8 2 5 9 9 6\n8 4 5 6 7 10 10 10 10\n8 4 10 7 7 11 11 11 11\n4 0 "
                  "1 2 3\n2 0 1\n",
                  "12\n12\n12\n12\n9\n3\n"},
        std::pair{"8 0 1 3 2 4 5 7 6\n6 1 2 8 5 6 9\n5 4 5 6 7 10\n6 4 10 7 11 11 11\n4 0 1 2 3\n2 0 1\n",
                  "11\n13\n14\n13\n9\n3\n"}}) {
    const Mesh_file file = read("t.vtk", legacy(cells, types));
    const Cell_soup<3> soup = volumes_of(file);
    EXPECT_EQ(six_volumes(soup).front(), 6);
    EXPECT_TRUE(all_closed(soup));
    EXPECT_EQ(shared_facets(soup), 3u);
    EXPECT_EQ(soup.cell_begin[4] - soup.cell_begin[3], 4u);
    EXPECT_GE(file.report.collapsed, 1u);
  }
}

TEST(VtkReader, PolyhedraAreReadAndTheirFacesMadeAlike) {
  const auto grid = grid_of({{VTK_HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7}}});
  // The pyramid on the hexahedron as a polyhedron, two of its faces the wrong way round.
  const vtkIdType faces[] = {4, 4, 7, 6, 5, 3, 4, 5, 10, 3, 6, 5, 10, 3, 6, 7, 10, 3, 4, 7, 10};
  grid->InsertNextCell(VTK_POLYHEDRON, 5, faces);
  for (const bool xml : {true, false}) {
    const Mesh_file file = xml ? read("t.vtu", written<vtkXMLUnstructuredGridWriter>(grid))
                               : read("t.vtk", written<vtkUnstructuredGridWriter>(grid));
    const Cell_soup<3> soup = volumes_of(file);
    EXPECT_EQ(six_volumes(soup), (std::vector<double>{6, 2}));
    EXPECT_TRUE(all_closed(soup));
    EXPECT_EQ(shared_facets(soup), 1u);
    EXPECT_EQ(file.report.notes,
              (std::vector<std::string>{"1 polyhedra had facets of either orientation: made alike"}));
  }
}

TEST(VtkReader, PrismsAndCellsOfHigherOrderAreRead) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> p;
  p->SetDataTypeToDouble();
  const double pi = std::acos(-1.0);
  for (int z = 0; z < 2; ++z)
    for (int i = 0; i < 5; ++i) p->InsertNextPoint(std::cos(2 * pi * i / 5), std::sin(2 * pi * i / 5), z);
  for (int i = 0; i < 10; ++i) p->InsertNextPoint(i == 1, i == 2, i == 3);
  grid->SetPoints(p);
  std::vector<vtkIdType> ids{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  grid->InsertNextCell(VTK_PENTAGONAL_PRISM, 10, ids.data());
  for (vtkIdType& i : ids) i += 10;
  grid->InsertNextCell(VTK_QUADRATIC_TETRA, 10, ids.data());
  const Mesh_file file = read("t.vtu", written<vtkXMLUnstructuredGridWriter>(grid));
  const Cell_soup<3> soup = volumes_of(file);
  EXPECT_TRUE(all_closed(soup));
  EXPECT_NEAR(six_volumes(soup, 0), 15 * std::sin(2 * pi / 5), 1e-12);
  EXPECT_EQ(six_volumes(soup, 1), 1);
  EXPECT_EQ(file.report.notes,
            (std::vector<std::string>{"1 cells of higher order read by their corner points, as straight"}));
}

TEST(VtkReader, PolygonalDataIsASurface) {
  const std::string text =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 "
      "0 1\n"
      "LINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 4\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n";
  const Mesh_file file = read("t.vtk", text);
  EXPECT_EQ(std::get<Surface_soup>(file.mesh).facets,
            (std::vector<std::vector<std::uint32_t>>{{0, 1, 4}, {0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(file.report.notes, (std::vector<std::string>{"1 point and line cells ignored"}));
}

TEST(VtkReader, FlatGridsAreCellsOfThePlane) {
  const auto flat = grid_of({});
  vtkNew<vtkPoints> p;
  for (int i = 0; i < 4; ++i) p->InsertNextPoint(i % 2, i / 2, 0);
  flat->SetPoints(p);
  const vtkIdType pixel[] = {0, 1, 2, 3};
  flat->InsertNextCell(VTK_PIXEL, 4, pixel);
  const Mesh_file file = read("t.vtu", written<vtkXMLUnstructuredGridWriter>(flat));
  const auto soup = std::get<Cell_soup<2>>(file.mesh);
  EXPECT_EQ(soup.vertices, (std::vector<std::uint32_t>{0, 1, 1, 3, 3, 2, 2, 0}));
}

TEST(VtkReader, BrokenFilesAreRefusedWithAReason) {
  const std::string xml = written<vtkXMLUnstructuredGridWriter>(
      the_cells(), [](vtkXMLUnstructuredGridWriter& w) { w.SetDataModeToAscii(); });
  const auto not_finite = the_cells();
  not_finite->GetPoints()->SetPoint(10, 0, std::numeric_limits<double>::quiet_NaN(), 2);
  struct Case {
    std::string name, text, message;
  };
  const Case cases[] = {
      {"t.vtk", legacy("8 0 1 3 2 4 5 7 6\n6 1 2 8 5 6 12\n5 4 5 6 7 10\n4 4 10 7 11\n4 0 1 2 3\n2 0 1\n"),
       ": cell 1 names point 12, of 12"},
      {"t.vtk",
       legacy("8 0 1 3 2 4 5 7 6\n6 1 2 8 5 6 9\n5 4 5 6 7 10\n4 4 10 7 11\n4 0 1 2 3\n2 0 1\n",
              "11\n13\n41\n10\n9\n3\n"),
       ": cell 2 is of VTK's type 41, which is not read"},
      {"t.vtk",
       legacy("8 0 1 3 2 4 5 7 6\n6 1 2 8 5 6 9\n5 4 5 6 7 10\n4 4 10 7 11\n4 0 1 2 3\n2 0 1\n",
              "11\n12\n14\n10\n9\n3\n"),
       ": cell 1 has 6 points, of 8 that its type takes"},
      {"t.vtu", written<vtkXMLUnstructuredGridWriter>(not_finite),
       ": point 10 has a coordinate that is not finite"},
      {"t.vtk", with(legacy(), "0 0 2", "0 two 2"), "Error reading ascii data"},
      {"t.vtk", with(legacy(), "UNSTRUCTURED_GRID", "SOMETHING"),
       "VTK cannot read it as VTK legacy 2.0 (its line DATASET is missing, or names an unknown kind)"},
      {"t.vtk",
       "# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 0 0\n"
       "SPACING 1 1 1\n",
       "only unstructured grids and polygonal data are read"},
      {"t.vtu", with(xml, "</Points>", "</Pints>"),
       "t.vtu:26: broken or cut short: VTK cannot read it as VTK XML UnstructuredGrid"},
      {"t.vtu", with(xml, "UnstructuredGrid", "ImageData"),
       "holds a ImageData: only UnstructuredGrid and PolyData are read"},
      {"t.vtu", "<?xml version=\"1.0\"?><other/>", ": not a VTK XML file: it has no tag <VTKFile type=...>"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    const std::string why = refusal([&] { read(c.name, c.text); });
    EXPECT_NE(why.find(c.message), std::string::npos) << why;
    EXPECT_EQ(why.find("0x"), std::string::npos) << "names an address: " << why;
  }
}

TEST(VtkReader, CountsThatNoFileOfItsSizeHoldsAreRefused) {
  const std::string xml = written<vtkXMLUnstructuredGridWriter>(
      the_cells(), [](vtkXMLUnstructuredGridWriter& w) { w.SetDataModeToAscii(); });
  const std::string packed = written<vtkXMLUnstructuredGridWriter>(the_cells());
  struct Case {
    std::string name, text, what;
  };
  const Case cases[] = {
      {"t.vtu", with(xml, "NumberOfPoints=\"12\"", "NumberOfPoints=\"4000000000\""), "4000000000 points"},
      {"t.vtu", with(packed, "NumberOfPoints=\"12\"", "NumberOfPoints=\"4000000000\""), "4000000000 points"},
      {"t.vtu", with(xml, "NumberOfCells=\"", "NumberOfCells=\"99999999999999999999999"),
       "18446744073709551615 cells"},
      {"t.vtk", with(legacy(), "POINTS 12", "POINTS 4000000000"), "4000000000 points"},
      {"t.vtk", with(legacy(), "CELLS 6", "CELLS 4000000000"), "4000000000 cells"},
      {"t.vtk", with(legacy(), "CELL_TYPES 6", "cell_types\t4000000000"), "4000000000 cell_types"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const std::string why = refusal([&] { read(c.name, c.text); });
    EXPECT_NE(why.find(c.name + ": announces " + c.what + ", more than its "), std::string::npos) << why;
  }
}

TEST(VtkReader, TruncatedFilesNeverCrash) {
  const auto count = [](const std::string& name, const std::string& text) {
    return refused_truncations(text, [&](const std::string& t) { read(name, t); });
  };
  const auto grid = the_cells();
  using Legacy = vtkUnstructuredGridWriter;
  using Xml = vtkXMLUnstructuredGridWriter;
  EXPECT_GE(count("t.vtk", legacy()), 15);
  EXPECT_GE(count("t.vtk", written<Legacy>(grid)), 10);
  EXPECT_GE(count("t.vtk", written<Legacy>(grid, [](Legacy& w) { w.SetFileTypeToBinary(); })), 10);
  EXPECT_GE(count("t.vtu", written<Xml>(grid, [](Xml& w) { w.SetDataModeToAscii(); })), 18);
  EXPECT_GE(count("t.vtu", written<Xml>(grid)), 15);
}

TEST(VtkReader, LeavesNoTraceInTheProgram) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_NE(refusal([] { read("t.vtk", with(legacy(), "UNSTRUCTURED_GRID", "SOMETHING")); }), "");
  EXPECT_NE(refusal([] { read("t.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"); }), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// What VTK reads from a .vtu text of this project.
vtkNew<vtkXMLUnstructuredGridReader> judged(const std::string& text) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  reader->Update();
  return reader;
}

TEST(VtuWriter, VtkReadsWhatIsWritten) {
  Cell_soup<3> soup = volumes_of(read("t.vtk", legacy()));
  soup.points[11] = {-1, 5e-324, 0x1.fffffffffffffp-1};
  for (const Vtu_encoding encoding : {Vtu_encoding::text, Vtu_encoding::base64}) {
    Vtu_grid grid = vtu_of_cells(soup);
    grid.point_data.push_back({"speed & <more>", 3, std::vector<double>(36, -0.125)});
    const auto reader = judged(vtu_text(grid, encoding));
    vtkUnstructuredGrid* found = reader->GetOutput();
    ASSERT_EQ(found->GetNumberOfPoints(), 12);
    ASSERT_EQ(found->GetNumberOfCells(), 4);
    for (vtkIdType i = 0; i < 12; ++i) {
      Point<3> p;
      found->GetPoint(i, p.data());
      EXPECT_EQ(p, soup.points[static_cast<std::size_t>(i)]);
    }
    EXPECT_EQ(found->GetCellType(0), VTK_HEXAHEDRON);
    EXPECT_EQ(found->GetCellType(1), VTK_WEDGE);
    EXPECT_EQ(found->GetCellType(3), VTK_TETRA);
    EXPECT_EQ(found->GetCell(1)->GetNumberOfFaces(), 5);
    EXPECT_EQ(found->GetCell(1)->GetNumberOfPoints(), 6);
    ASSERT_NE(found->GetPointData()->GetArray("speed & <more>"), nullptr);
    EXPECT_EQ(found->GetPointData()->GetArray("speed & <more>")->GetComponent(11, 2), -0.125);
    EXPECT_EQ(found->GetCellData()->GetArray("cell")->GetTuple1(3), 3);
    // Read by this library, the written cells are the same cells.
    const Cell_soup<3> again = volumes_of(read("t.vtu", vtu_text(grid, encoding)));
    EXPECT_EQ(six_volumes(again), six_volumes(soup));
    EXPECT_TRUE(all_closed(again));
  }
}

TEST(VtuWriter, VtkReadsLinesPolygonsAndEmptyGrids) {
  Vtu_grid grid;
  for (double x : {0., 1., 2., 3.}) grid.points.push_back({x, x * x, 0});
  grid.add_cell(Vtu_cell::polyline, std::vector<std::uint32_t>{0, 1, 2, 3});
  grid.add_cell(Vtu_cell::vertex, std::vector<std::uint32_t>{2});
  const auto reader = judged(vtu_text(grid));
  EXPECT_EQ(reader->GetOutput()->GetCellType(0), VTK_POLY_LINE);
  EXPECT_EQ(reader->GetOutput()->GetCell(0)->GetNumberOfPoints(), 4);
  EXPECT_EQ(reader->GetOutput()->GetCellType(1), VTK_VERTEX);
  testing::internal::CaptureStderr();
  const auto none = judged(vtu_text({}));
  EXPECT_EQ(none->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "a frame without contacts is no error";
}

}  // namespace
}  // namespace cellwalk::io
