// SPDX-License-Identifier: LGPL-3.0-or-later
// Frames of a run, read by VTK: what ParaView sees.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

class RunFrames : public Program {
 protected:
  /// Calls check(grid) for a file of the run; VTK must have read it without a complaint.
  template <class Check>
  void with_grid(const std::string& file, Check check) const {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    ASSERT_TRUE(reader->CanReadFile(path(file).c_str())) << file;
    reader->SetFileName(path(file).c_str());
    reader->Update();
    ASSERT_EQ(reader->GetErrorCode(), 0u) << file;
    check(*reader->GetOutput());
  }
};

TEST_F(RunFrames, AreReadByVtk) {
  write("room.json", R"({
    "environment": {"generate": "hexes", "cells": [4, 3, 3]},
    "particles": [{"count": 20, "seed": 3, "speed": 12}],
    "time_step": 0.125, "steps": 30, "output": {"frame_every": 15}})");
  succeed({"run", "room.json", "-o", "out"});
  const auto table = read_table(path("out/contacts.csv"));

  std::array<std::size_t, 3> contacts_of_frame{};
  for (std::size_t i = 1; i < table.size(); ++i) ++contacts_of_frame[(std::stoul(table[i][0]) + 14) / 15];
  EXPECT_GT(contacts_of_frame[1] + contacts_of_frame[2], 50u);

  for (std::size_t frame = 0; frame < 3; ++frame) {
    const std::string number = "_0000" + std::to_string(frame) + ".vtu";
    with_grid("out/frames/particles" + number, [&](vtkUnstructuredGrid& grid) {
      ASSERT_EQ(grid.GetNumberOfPoints(), 20);
      ASSERT_EQ(grid.GetNumberOfCells(), 20);
      vtkDataArray* met = grid.GetPointData()->GetArray("contacts");
      vtkDataArray* velocity = grid.GetPointData()->GetArray("velocity");
      ASSERT_TRUE(met && velocity);
      EXPECT_EQ(velocity->GetNumberOfComponents(), 3);
      double sum = 0;
      for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
        sum += met->GetTuple1(i);
        const double* p = grid.GetPoint(i);
        EXPECT_TRUE(p[0] >= 0 && p[0] <= 4 && p[1] >= 0 && p[1] <= 3 && p[2] >= 0 && p[2] <= 3);
        const double* v = velocity->GetTuple3(i);
        EXPECT_NEAR(std::hypot(v[0], v[1], v[2]), 12, 1e-9);
      }
      EXPECT_EQ(sum, static_cast<double>(contacts_of_frame[frame]));
    });
    with_grid("out/frames/contacts" + number, [&](vtkUnstructuredGrid& grid) {
      ASSERT_EQ(static_cast<std::size_t>(grid.GetNumberOfPoints()), contacts_of_frame[frame]);
      vtkDataArray* normal = grid.GetPointData()->GetArray("normal");
      ASSERT_TRUE(normal);
      for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
        const double* n = normal->GetTuple3(i);
        EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-15);
      }
    });
  }
  with_grid("out/walls.vtu", [](vtkUnstructuredGrid& grid) {
    EXPECT_EQ(grid.GetNumberOfCells(), 2 * (4 * 3 + 4 * 3 + 3 * 3)) << "the squares of the room's surface";
  });
}

TEST_F(RunFrames, BodiesAreReadByVtk) {
  write("grid.json", R"({
    "environment": {"generate": "hexes", "cells": [4, 3, 3]},
    "bodies": [{"shape": "hexahedron", "side": 0.4, "count": 10, "seed": 3, "speed": 4},
               {"shape": "tetrahedron", "count": 1, "speed": 0}],
    "time_step": 0.0625, "steps": 30, "output": {"frame_every": 15}})");
  succeed({"run", "grid.json", "-o", "out"});
  EXPECT_FALSE(exists("out/frames/particles_00000.vtu")) << "there are none";

  // Contacts by frame, then by body, feature and number.
  std::array<std::map<std::array<double, 3>, double>, 3> contacts;
  const auto table = read_table(path("out/contacts.csv"));
  for (std::size_t i = 1; i < table.size(); ++i) {
    const double feature = table[i][13] == "vertex" ? 0 : 1;
    ++contacts[(std::stoul(table[i][0]) + 14) / 15]
              [{std::stod(table[i][11]), feature, std::stod(table[i][14])}];
  }
  EXPECT_GT(contacts[1].size() + contacts[2].size(), 30u);

  for (std::size_t frame = 0; frame < 3; ++frame) {
    const std::string number = "_0000" + std::to_string(frame) + ".vtu";
    with_grid("out/frames/bodies" + number, [&](vtkUnstructuredGrid& grid) {
      ASSERT_EQ(grid.GetNumberOfPoints(), 10 * 8 + 4);
      ASSERT_EQ(grid.GetNumberOfCells(), 10 * (8 + 12) + 4 + 6 + 4);
      const auto cell_value = [&](const char* name, vtkIdType i) {
        return grid.GetCellData()->GetArray(name)->GetTuple1(i);
      };
      for (const char* name : {"body", "feature", "number", "contacts"})
        ASSERT_TRUE(grid.GetCellData()->GetArray(name)) << name;
      std::map<std::array<double, 3>, double> met;
      std::map<int, int> types;
      for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
        const double feature = cell_value("feature", i), count = cell_value("contacts", i);
        EXPECT_EQ(grid.GetCell(i)->GetNumberOfPoints(), feature + 1);
        ++types[grid.GetCellType(i)];
        if (count > 0) met[{cell_value("body", i), feature, cell_value("number", i)}] = count;
        for (int k = 0; k < grid.GetCell(i)->GetNumberOfPoints(); ++k)
          EXPECT_EQ(grid.GetPointData()->GetArray("body")->GetTuple1(grid.GetCell(i)->GetPointId(k)),
                    cell_value("body", i));
      }
      EXPECT_EQ(met, contacts[frame]);
      EXPECT_EQ(types, (std::map<int, int>{{VTK_VERTEX, 84}, {VTK_LINE, 126}, {VTK_TRIANGLE, 4}}));
      vtkDataArray* velocity = grid.GetPointData()->GetArray("velocity");
      ASSERT_TRUE(velocity);
      std::size_t at_speed = 0;
      for (vtkIdType i = 0; i < 80; ++i) {
        const double* v = velocity->GetTuple3(i);
        at_speed += std::abs(std::hypot(v[0], v[1], v[2]) - 4) < 1e-9;
      }
      EXPECT_GT(at_speed, frame == 0 ? 79u : 30u);
      for (vtkIdType i = 80; i < 84; ++i) {
        EXPECT_EQ(velocity->GetTuple3(i)[0], 0) << "at rest";
      }
    });
    with_grid("out/frames/contacts" + number, [&](vtkUnstructuredGrid& grid) {
      std::map<std::array<double, 3>, double> met;
      for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
        const auto value = [&](const char* name) {
          return grid.GetPointData()->GetArray(name)->GetTuple1(i);
        };
        ++met[{value("body"), value("feature"), value("number")}];
        EXPECT_EQ(value("particle"), -1);
      }
      EXPECT_EQ(met, contacts[frame]);
    });
  }
}

}  // namespace
}  // namespace cellwalk::test
