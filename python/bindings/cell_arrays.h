// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells in the arrays of other programs: rows of one type, blocks of types as meshio has them, and the flat
// arrays of VTK and PyVista.
#ifndef CELLWALK_PYTHON_CELL_ARRAYS_H
#define CELLWALK_PYTHON_CELL_ARRAYS_H

#include <cellwalk/records/cell_soup.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "arrays.h"

namespace cellwalk::python {

/// A type of cells by its names.
struct Cell_type {
  std::string_view name;  ///< that of meshio
  int code;               ///< that of VTK
  int dimension;
  std::size_t corners;  ///< 0: any number of them
};

/// Cells as they were given.
struct Given_cells {
  struct Cell {
    const Cell_type* type;
    std::size_t begin, end;  ///< in `corners`
  };
  std::vector<Cell> cells;
  /// In the order of meshio; of a polyhedron, for each face the number of its corners, then these.
  std::vector<std::uint32_t> corners;

  /// The highest dimension.
  int dimension() const;
  std::span<const std::uint32_t> of(const Cell& cell) const {
    return {corners.data() + cell.begin, corners.data() + cell.end};
  }
};

/// \param cells with `types` None, an integer array (M, k), a mapping of types to such arrays, or a sequence
///        of blocks, each of a type and an array; with types (M,) of VTK the flat array of their corners,
///        each cell after the number of its corners
/// \param name for messages
/// \param type_of_rows of an array (M, k); empty: by k
/// \throw TypeError, InputError, or RowError naming a point that does not exist
Given_cells cells_of(const py::object& cells, const py::object& types, const char* name,
                     std::string_view type_of_rows, std::size_t point_count);

/// Adds the cells of the dimension of the soup, and returns how many there are of each other type.
template <int D>
std::map<std::string_view, std::size_t> add_cells(Cell_soup<D>& soup, const Given_cells& given);

/// Makes facets walls, which are given by their corners in any order, in an array or in blocks.
/// \throw InputError naming the first that no cell has
template <int D>
void add_walls(Cell_soup<D>& soup, const py::object& walls);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_CELL_ARRAYS_H
