// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells as arrays: tables of them, and the names in the rows of arrays.
#ifndef CELLWALK_PYTHON_CELL_TABLES_H
#define CELLWALK_PYTHON_CELL_TABLES_H

#include <cellwalk/environment/selection.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arrays.h"

namespace cellwalk::python {

/// The rows of a table. Needs no interpreter.
struct Cell_table {
  bool of_facets = true;
  std::size_t dimension = 0, most_points = 0, row_size = 0;
  std::vector<std::uint8_t> rows;
};

template <int D>
Cell_table cell_table_of(const Snapshot<D>& snapshot, std::span<const Half_facet> facets);
template <int D>
Cell_table cell_table_of(const Snapshot<D>& snapshot, std::span<const Cell> cells);

/// All facets, each once, and all cells.
template <int D>
Selection<D> all_of(const Snapshot<D>& snapshot);

bool has_field(const py::array& array, const char* field);

/// A structured array.
py::array to_array(const Cell_table& table);

/// The cells that an array names: rows of such a table, of contacts, or numbers. They are looked up when the
/// world is held.
class Named_cells {
 public:
  /// \param name of the argument
  /// \throw TypeError for anything else than integers (N,), or a structured array with a field `cell`
  Named_cells(const py::handle& argument, const char* name);

  std::size_t size() const { return cells_.size(); }
  /// None if there are points as well, and the cell of the number has others.
  /// \throw ValueError if there is no such cell
  template <int D>
  Cell find(const Snapshot<D>& snapshot, std::size_t row) const;

 private:
  const char* name_;
  std::vector<std::int64_t> cells_;
  std::vector<std::int64_t> points_;  ///< `width_` a row, ascending
  std::size_t width_ = 0;
};

class Named_facets {
 public:
  /// \throw TypeError for anything else than integers (N, 2), or a structured array with fields `cell` and
  ///        `facet`
  Named_facets(const py::handle& argument, const char* name);

  std::size_t size() const { return cells_.size(); }
  template <int D>
  Half_facet find(const Snapshot<D>& snapshot, std::size_t row) const;

 private:
  const char* name_;
  std::vector<std::int64_t> cells_, facets_, points_;
  std::size_t width_ = 0;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_CELL_TABLES_H
