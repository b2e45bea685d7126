// SPDX-License-Identifier: LGPL-3.0-or-later
// Frames of a run, read by VTK: what ParaView sees.
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

class Run_frames : public Program {
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

TEST_F(Run_frames, AreReadByVtk) {
  write("room.json", R"({
    "environment": {"generate": "hexes", "cells": [4, 3, 3]},
    "particles": [{"count": 20, "seed": 3, "speed": 12}],
    "catheter": {"path": [[0.2, 1.5, 1.4], [9, 1.5, 1.6]], "spacing": 0.3, "particles": 8},
    "time_step": 0.125, "steps": 30, "output": {"frame_every": 15}})");
  succeed({"run", "room.json", "-o", "out"});
  const auto table = read_table(path("out/contacts.csv"));

  std::array<std::size_t, 3> contacts_of_frame{};
  for (std::size_t i = 1; i < table.size(); ++i) ++contacts_of_frame[(std::stoul(table[i][0]) + 14) / 15];
  EXPECT_GT(contacts_of_frame[1] + contacts_of_frame[2], 50u);

  for (std::size_t frame = 0; frame < 3; ++frame) {
    const std::string number = "_0000" + std::to_string(frame) + ".vtu";
    with_grid("out/frames/particles" + number, [&](vtkUnstructuredGrid& grid) {
      const vtkIdType catheter = frame == 0 ? 1 : 8;
      ASSERT_EQ(grid.GetNumberOfPoints(), 20 + catheter);
      ASSERT_EQ(grid.GetNumberOfCells(), 20 + catheter + (frame == 0 ? 0 : 1));
      if (frame > 0) {
        EXPECT_EQ(grid.GetCell(28)->GetCellType(), VTK_POLY_LINE);
        EXPECT_EQ(grid.GetCell(28)->GetNumberOfPoints(), 8);
      }
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
        if (i < 20) {
          EXPECT_NEAR(std::hypot(v[0], v[1], v[2]), 12, 1e-9);
        }
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

}  // namespace
}  // namespace cellwalk::test
