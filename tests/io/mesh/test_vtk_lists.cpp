// SPDX-License-Identifier: LGPL-3.0-or-later
// Lists of legacy files with which VTK would leave its memory, and names that look like them.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGridWriter.h>

#include <array>
#include <string>
#include <vector>

#include "vtk_files.h"

namespace cellwalk::io {
namespace {

// VTK would write beyond the memory that it takes for the numbers announced.
TEST(VtkLists, CellsThatTakeOtherNumbersThanAnnouncedAreRefused) {
  const std::string sound = legacy();
  const std::size_t at = sound.find("CELLS 6 ") + 8;
  int refused = 0;
  for (int numbers = 1; numbers < 80; ++numbers) {
    if (numbers == 35) continue;
    std::string other = sound;
    other.replace(at, 2, std::to_string(numbers));
    EXPECT_THROW(read("t.vtk", other), Error) << numbers;
    ++refused;
  }
  EXPECT_EQ(refused, 78);
  const auto grid = the_cells();
  std::string binary = written<vtkUnstructuredGridWriter>(grid, [](vtkUnstructuredGridWriter& w) {
    w.SetFileTypeToBinary();
    w.SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  });
  const std::size_t list = binary.find('\n', binary.find("CELLS ")) + 1;
  for (const char corners : {'\x07', '\x09', '\x7f'}) {
    std::string other = binary;
    other[list + 3] = corners;
    EXPECT_THROW(read("t.vtk", other), Error);
    other[list] = '\xff';
    EXPECT_THROW(read("t.vtk", other), Error);
  }
}

/// A list of few cells in a file with so many numbers that VTK would write far beyond the memory of the list.
std::string overfull(const std::string& before, const std::string& list) {
  std::string text = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n" + before + list;
  for (int i = 0; i < 10'000; ++i) text += "0 ";
  return text + "\nCELL_TYPES 1\n10\n";
}

// VTK finds lists in more places than at the beginning of a word, and reads more as a number than digits.
TEST(VtkLists, ListsAreFoundWhereVtkFindsThem) {
  const std::string point = "POINTS 1 float\n0 0 0";
  const std::string long_word = "CELLS" + std::string(250, 'x');
  int refused = 0;
  for (const std::string& before :
       std::vector<std::string>{point + "\n", point, "FIELD f 0\n" + point + "\n", "FIELD f 0", "", "\v\f"})
    for (const std::string word : {"CELLS ", "cElLs\n", "CELLSx ", "CELLS_OF_MINE\t"})
      for (const std::string numbers :
           {"1 2 ", "+1 +2 ", "001 002 ", "1\n2\n", "1 -2 ", "1 0 ", "2 3 1 0 ", "-1 2 "})
        for (const std::string corners : {"9999 ", "+9999 ", "009999\n", "9998.5 ", "-9 ", "3 "}) {
          if (numbers == "-1 2 " && corners != "3 ") continue;
          EXPECT_THROW(read("t.vtk", overfull(before, word + numbers + corners)), Error)
              << before << "|" << word << "|" << numbers << "|" << corners;
          ++refused;
        }
  EXPECT_EQ(refused, 6 * 4 * (7 * 6 + 1));
  EXPECT_THROW(read("t.vtk", overfull(point + "\n", long_word + "1 2 9999 ")), Error);
  EXPECT_THROW(read("t.vtk", overfull(point + "\n", "CELLS 1 0 none ")), Error);
}

TEST(VtkLists, BinaryListsThatBeginLikeThoseWithOffsetsAreExamined) {
  std::string text = "# vtk DataFile Version 2.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n" +
                     std::string(12, '\0') + "CELLS 1 40\nOFFSETS " + std::string(400'000, '\0');
  EXPECT_THROW(read("t.vtk", text), Error);
  EXPECT_THROW(read("t.vtk", with(text, "CELLS 1 40\nOFFSETS", "CELLS 1 40 int\nOFFSETS")), Error);
}

TEST(VtkLists, CellsWithoutTypesAreRefused) {
  const std::string sound = legacy();
  int refused = 0;
  for (int types = 0; types < 6; ++types, ++refused) {
    const std::string why =
        refusal([&] { read("t.vtk", with(sound, "CELL_TYPES 6", "CELL_TYPES " + std::to_string(types))); });
    EXPECT_NE(why.find("the numbers of cells and of cell types differ"), std::string::npos) << why;
  }
  EXPECT_EQ(refused, 6);
  EXPECT_THROW(read("t.vtk", with(sound, "POINTS 12", "POINTS -12")), Error);
}

// Names may be those of lists. Each file is as VTK writes it.
// VTK would read the faces of a polyhedron beyond its list.
TEST(VtkLists, FacesOfPolyhedraEndWithTheirList) {
  const std::string before = "ASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::array<int, 17> sound{4, 3, 0, 1, 2, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
  const auto file = [&](int version, const std::vector<int>& stream) {
    const auto size = std::to_string(stream.size()), more = std::to_string(stream.size() + 1);
    std::string text = "# vtk DataFile Version " + std::to_string(version) + ".1\nt\n" + before;
    text += version == 5
                ? "CELLS 2 " + size + "\nOFFSETS vtktypeint64\n0 " + size + "\nCONNECTIVITY vtktypeint64\n"
                : "CELLS 1 " + more + "\n" + size + " ";
    for (const int number : stream) text += std::to_string(number) + " ";
    return text + "\nCELL_TYPES 1\n42\n";
  };
  int refused = 0;
  for (const int version : {4, 5}) {
    const std::vector<int> stream(sound.begin(), sound.end());
    EXPECT_EQ(volumes_of(read("t.vtk", file(version, stream))).cell_count(), 1u);
    for (std::size_t at : {0, 1, 5, 9, 13})
      for (const int number : {-1, 5, 17, 1000, 100'000, 2'000'000'000}) {
        std::vector<int> other = stream;
        other[at] = number;
        EXPECT_THROW(read("t.vtk", file(version, other)), Error) << at << " " << number;
        ++refused;
      }
    for (std::size_t size = 0; size < stream.size(); ++size, ++refused)
      EXPECT_THROW(read("t.vtk", file(version, {stream.begin(), stream.begin() + size})), Error) << size;
  }
  EXPECT_EQ(refused, 2 * (30 + 17));
}

TEST(VtkLists, OffsetsStayInTheConnectivity) {
  vtkNew<vtkUnstructuredGrid> grid = grid_of({});
  const vtkIdType faces[] = {3, 0, 1, 2, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 0, 4};
  grid->InsertNextCell(VTK_POLYHEDRON, 4, faces);
  const std::string binary =
      written<vtkUnstructuredGridWriter>(grid, [](auto& writer) { writer.SetFileTypeToBinary(); });
  EXPECT_EQ(volumes_of(read("t.vtk", binary)).cell_count(), 1u);
  const std::size_t at = binary.find('\n', binary.find("OFFSETS")) + 1;
  int refused = 0;
  for (std::size_t byte = 0; byte < 16; ++byte)
    for (const char value : {'\x01', '\x7f', '\x80', '\xff'}) {
      std::string other = binary;
      other[at + byte] = value;
      if (other == binary) continue;
      EXPECT_THROW(read("t.vtk", other), Error) << byte;
      ++refused;
    }
  EXPECT_GE(refused, 60);
}

TEST(VtkLists, ArraysMayHaveTheNamesOfLists) {
  const auto grid = the_cells();
  const auto array = [](const std::string& name, int values, int components) {
    vtkNew<vtkIntArray> result;
    result->SetName(name.c_str());
    result->SetNumberOfComponents(components);
    for (int i = 0; i < values * components; ++i) result->InsertNextValue(i % 7);
    return result;
  };
  int read_well = 0;
  for (const std::string name : {"cells", "lines", "vertices", "polygons", "triangle_strips", "points",
                                 "cell_types", "CELLS", "point_data", "cell_data", "my_cells"})
    for (const bool is_binary : {false, true})
      for (const auto version :
           {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1})
        for (int kind = 0; kind < 5; ++kind) {
          vtkNew<vtkUnstructuredGrid> named;
          named->ShallowCopy(grid);
          if (kind == 0) named->GetCellData()->SetScalars(array(name, 4, 1));
          if (kind == 1) named->GetPointData()->SetVectors(array(name, 12, 3));
          if (kind == 2) named->GetCellData()->AddArray(array(name, 4, 2));
          if (kind == 3) named->GetPointData()->AddArray(array(name, 12, 1));
          if (kind == 4) named->GetFieldData()->AddArray(array(name, 8, 1));
          const std::string text =
              written<vtkUnstructuredGridWriter>(named, [&](vtkUnstructuredGridWriter& w) {
                if (is_binary) w.SetFileTypeToBinary();
                w.SetFileVersion(version);
                if (kind == 0) w.SetScalarsName(name.c_str());
                if (kind == 1) w.SetVectorsName(name.c_str());
              });
          SCOPED_TRACE(text);
          ASSERT_NE(text.find(name), std::string::npos);
          expect_the_cells(read("t.vtk", text));
          ++read_well;
        }
  EXPECT_EQ(read_well, 11 * 2 * 2 * 5);
  // A table of colours, whose values follow its name.
  for (const std::string values :
       {"4\n0 0 0 1\n1 0 0 1\n1 1 0 1\n1 1 1 1\n", "4\n2 0 0 1\n1 0 0 1\n1 1 0 1\n1 1 1 1\n"})
    EXPECT_EQ(
        read("t.vtk",
             legacy() + "CELL_DATA 6\nSCALARS s int 1\nLOOKUP_TABLE cells\n1 2 3 4 5 6\nLOOKUP_TABLE cells " +
                 values)
            .report.cells,
        4u);
}

TEST(VtkLists, ListsWithinListsTakeNoLongerThanOne) {
  std::string text = "# vtk DataFile Version 2.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n" +
                     std::string(12, '\0');
  // Each list passes over the heads of those after it: the five corners of its first cells.
  const std::string head = std::string("\0\0\0\5cells 222222 444444\n", 24);
  for (int i = 0; i < 200'000; ++i) text += head;
  EXPECT_THROW(read("t.vtk", text), Error);
}

}  // namespace
}  // namespace cellwalk::io
