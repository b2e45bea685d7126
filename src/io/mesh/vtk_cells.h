// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: cells of VTK's data sets as elements.
#ifndef CELLWALK_IO_MESH_VTK_CELLS_H
#define CELLWALK_IO_MESH_VTK_CELLS_H

#include <string>
#include <vector>

#include "collapsed_cells.h"
#include "element_soup.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace cellwalk::io {

struct Read_elements {
  Element_soup elements;
  std::vector<std::string> notes;
  Collapsed_cells collapsed;
};

/// \throw Error(input) if an index or offset is out of range, or for cells of an unsupported type
Read_elements read_cells(const std::string& name, vtkUnstructuredGrid& grid);
Read_elements read_cells(const std::string& name, vtkPolyData& surface);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_VTK_CELLS_H
