// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of VTK with a cell of each kind, by hand and as VTK writes them.
#ifndef CELLWALK_TESTS_IO_MESH_VTK_FILES_H
#define CELLWALK_TESTS_IO_MESH_VTK_FILES_H

#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/io_fixture.h"
#include "volumes.h"

namespace cellwalk::io {

inline Mesh_file read(const std::string& name, const std::string& text) {
  const Folder folder;
  return read_mesh(folder.write(name, text));
}

inline Cell_soup<3> volumes_of(const Mesh_file& file) { return std::get<Cell_soup<3>>(file.mesh); }

inline const std::string points =
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n2 0 0\n2 0 1\n0 0 2\n-1 0 1\n";

/// A voxel, a wedge in the order of VTK, a pyramid, a tetrahedron; a quad and a line.
inline std::string legacy(
    const std::string& cells =
        "8 0 1 3 2 4 5 7 6\n6 1 2 8 5 6 9\n5 4 5 6 7 10\n4 4 10 7 11\n4 0 1 2 3\n2 0 1\n",
    const std::string& types = "11\n13\n14\n10\n9\n3\n") {
  const auto numbers = std::ranges::count_if(cells, [](char c) { return c == ' ' || c == '\n'; });
  return "# vtk DataFile Version 2.0\na title\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n" +
         points + "CELLS 6 " + std::to_string(numbers) + "\n" + cells + "CELL_TYPES 6\n" + types;
}

inline vtkNew<vtkUnstructuredGrid> grid_of(const std::vector<std::pair<int, std::vector<vtkIdType>>>& cells) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> p;
  p->SetDataTypeToDouble();
  double x[3];
  std::istringstream in(points);
  while (in >> x[0] >> x[1] >> x[2]) p->InsertNextPoint(x);
  grid->SetPoints(p);
  for (const auto& [type, ids] : cells)
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
  return grid;
}

template <class Writer>
std::string written(vtkUnstructuredGrid* grid, const std::function<void(Writer&)>& set = {}) {
  const Folder folder;
  vtkNew<Writer> writer;
  writer->SetInputData(grid);
  writer->SetFileName((folder / "t").c_str());
  if (set) set(*writer);
  writer->Write();
  return content_of(folder / "t");
}

inline const std::vector<double> volumes{6, 3, 2, 1};  // sixths

inline void expect_the_cells(const Mesh_file& file) {
  const Cell_soup<3> soup = volumes_of(file);
  EXPECT_EQ(soup.points.size(), 12u);
  EXPECT_EQ(six_volumes(soup), volumes);
  EXPECT_TRUE(all_closed(soup));
  EXPECT_EQ(shared_facets(soup), 3u);
}

inline vtkNew<vtkUnstructuredGrid> the_cells() {
  return grid_of({{VTK_HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7}},
                  {VTK_WEDGE, {1, 2, 8, 5, 6, 9}},
                  {VTK_PYRAMID, {4, 5, 6, 7, 10}},
                  {VTK_TETRA, {4, 10, 7, 11}}});
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_MESH_VTK_FILES_H
