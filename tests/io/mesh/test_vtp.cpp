// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled where VTK is there. Surfaces in .vtp files, in every encoding that its writer has, and by hand.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;
using Notes = std::vector<std::string>;

Mesh_file read_vtp(const std::string& text, const std::string& name = "t.vtp") {
  const Folder folder;
  return read_mesh(folder.write(name, text));
}

/// A triangle and a quadrilateral, a strip of two triangles, a line and two points.
vtkNew<vtkPolyData> five_parts() {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 8; ++i) points->InsertNextPoint(i & 1, i >> 1 & 1, 0.1 * (i >> 2));
  const auto cells = [](const std::vector<std::vector<vtkIdType>>& rows) {
    vtkNew<vtkCellArray> array;
    for (const auto& row : rows) array->InsertNextCell(static_cast<vtkIdType>(row.size()), row.data());
    return array;
  };
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells({{0, 1, 4}, {0, 1, 3, 2}}));
  surface->SetStrips(cells({{4, 5, 6, 7}}));
  surface->SetLines(cells({{0, 5, 2}}));
  surface->SetVerts(cells({{0}, {3}}));
  return surface;
}

std::string written(vtkPolyData* surface, const std::function<void(vtkXMLPolyDataWriter&)>& set) {
  const Folder folder;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName((folder / "t").c_str());
  set(*writer);
  writer->Write();
  return content_of(folder / "t");
}

/// The writer's settings, each of which makes another file.
std::vector<std::function<void(vtkXMLPolyDataWriter&)>> all_encodings() {
  using Writer = vtkXMLPolyDataWriter;
  std::vector<std::function<void(Writer&)>> all{[](Writer& w) { w.SetDataModeToAscii(); }};
  for (const bool is_wide : {false, true})
    for (const int compressor : {Writer::NONE, Writer::ZLIB, Writer::LZ4, Writer::LZMA})
      for (const int mode : {Writer::Binary, Writer::Appended})
        for (const bool is_base64 : {false, true})
          if (mode == Writer::Appended || is_base64)
            all.push_back([=](Writer& w) {
              w.SetDataMode(mode);
              w.SetEncodeAppendedData(is_base64);
              w.SetCompressorType(compressor);
              w.SetHeaderType(is_wide ? Writer::UInt64 : Writer::UInt32);
            });
  return all;
}

TEST(Vtp, PolygonsAndStripsAreASurfaceInEveryEncoding) {
  const auto surface = five_parts();
  std::set<std::string> files;
  for (const auto& encoding : all_encodings()) {
    const std::string text = written(surface, encoding);
    SCOPED_TRACE(text.substr(0, 160));
    files.insert(text);
    const Mesh_file file = read_vtp(text);
    EXPECT_EQ(file.report.format, "VTK XML PolyData");
    EXPECT_EQ(file.report.notes, (Notes{"3 point and line cells ignored"}));
    const auto& soup = std::get<Surface_soup>(file.mesh);
    EXPECT_EQ(soup.facets, (Loops{{0, 1, 4}, {0, 1, 3, 2}, {4, 5, 6}, {6, 5, 7}}));
    ASSERT_EQ(soup.points.size(), 8u);
    EXPECT_EQ(soup.points[7], (Point<3>{1, 1, 0.1}));
  }
  EXPECT_EQ(files.size(), 1u + 2 * 4 * 3) << "each is a file of its own";
}

const std::string by_hand =
    "<?xml version='1.0'?>\n<VTKFile type='PolyData' version='0.1' byte_order='LittleEndian'>\n<PolyData>\n"
    "<Piece NumberOfPoints='4' NumberOfVerts='0' NumberOfLines='0' NumberOfStrips='0' NumberOfPolys='2'>\n"
    "<Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>\n"
    "0 0 0 1 0 0 0 1 0 0.1 0.2 0.30000000000000004\n</DataArray></Points>\n"
    "<Polys><DataArray type='Int64' Name='connectivity' format='ascii'>0 1 2 0 1 3</DataArray>\n"
    "<DataArray type='Int64' Name='offsets' format='ascii'>3 6</DataArray></Polys>\n"
    "</Piece>\n</PolyData>\n</VTKFile>\n";

TEST(Vtp, WrittenByHandIsReadExactly) {
  const Mesh_file file = read_vtp(by_hand);
  const auto& soup = std::get<Surface_soup>(file.mesh);
  EXPECT_EQ(soup.facets, (Loops{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(soup.points[3], (Point<3>{0.1, 0.2, 0.1 + 0.2}));
  EXPECT_EQ(read_vtp(by_hand, "t.bin").report.format, "VTK XML PolyData") << "recognized by its content";
}

TEST(Vtp, PiecesAreReadAsOneSurface) {
  const std::size_t begin = by_hand.find("<Piece"), end = by_hand.find("</PolyData>");
  const Mesh_file file =
      read_vtp(by_hand.substr(0, end) + by_hand.substr(begin, end - begin) + by_hand.substr(end));
  EXPECT_EQ(std::get<Surface_soup>(file.mesh).facets, (Loops{{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {4, 5, 7}}));
}

TEST(Vtp, BrokenFilesAreRefused) {
  struct Case {
    std::string from, to, message;
  };
  const Case cases[] = {
      {"0 1 2 0 1 3<", "0 1 2 0 1 4<", ": cell 1 names point 4, of 4"},
      {"0 1 2 0 1 3<", "0 1 2 0 -1 3<", ": cell 1 names point -1, of 4"},
      {">3 6<", ">3 9<", "t.vtp: "},
      {">3 6<", ">4 6<", ": cell 1: a polygon of 2 points"},
      {"NumberOfPolys='2'", "NumberOfPolys='2000000000'", "announces 2000000000 polys, more"},
      {"NumberOfPolys='2'", "NumberOfPolys='0'", ": holds neither volume cells nor polygons"},
      {"0.30000000000000004", "nan", ": point 3 has a coordinate that is not finite"},
      {"</Points>", "</Pints>", ": broken or cut short"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.to);
    const std::string why = refusal([&] { read_vtp(with(by_hand, c.from, c.to)); });
    EXPECT_NE(why.find(c.message), std::string::npos) << why;
  }
  EXPECT_GE(refused_truncations(by_hand, [](const std::string& text) { read_vtp(text); }), 18);
}

}  // namespace
}  // namespace cellwalk::io
