// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: cells of a fixed number of corners, some of which repeat. Solvers such as Ansys and LS-DYNA
// write wedges, pyramids and tetrahedra as hexahedra of this kind.
#ifndef CELLWALK_IO_MESH_COLLAPSED_CELLS_H
#define CELLWALK_IO_MESH_COLLAPSED_CELLS_H

#include <cellwalk/io/mesh_file.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::io {

/// The cells and polygons whose repeated corners were left out, by the shapes that remain.
class Collapsed_cells {
 public:
  /// Leaves repeated corners out of the last cell of a soup: corners beside each other in a loop that are the
  /// same point or have the same coordinates. Loops of fewer than three corners leave the cell, and loops of
  /// opposite order cancel. A cell without such corners stays as it is, and so does one with a loop that
  /// passes a point twice, which is refused when the environment is built.
  /// \param name, place the file, and the cell for an error, such as "cell 3"
  /// \throw Error(input) if fewer than four facets are left
  void settle_last(Cell_soup<3>& soup, const std::string& name, const std::string& place);

  /// The same of a polygon. One of fewer than three different corners stays as it is.
  void settle(std::vector<std::uint32_t>& polygon, const std::vector<Point<3>>& points);

  /// Adds the counts to a report, with a note.
  void report_to(Read_report& report) const;

 private:
  std::size_t wedges_ = 0, pyramids_ = 0, tetrahedra_ = 0, others_ = 0, polygons_ = 0;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_COLLAPSED_CELLS_H
