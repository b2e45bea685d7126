// SPDX-License-Identifier: LGPL-3.0-or-later
// Delaunay triangulations by CGAL, as environments with the same tetrahedra.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TRIANGULATION_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TRIANGULATION_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/records/cell_soup.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cstdint>
#include <vector>

namespace cellwalk::track_lengths {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex_base = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Cell_base = CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                                            CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>>;

/// A triangulation whose cells know their names in the snapshot of the same tetrahedra.
class Triangulation {
 public:
  /// \pre no two points are equal
  explicit Triangulation(const std::vector<Point<3>>& points);

  const Delaunay& delaunay() const { return delaunay_; }
  /// Its tetrahedra, in an order that depends on the points alone.
  const Cell_soup<3>& soup() const { return soup_; }
  /// Names the cells as the snapshot does, into which the soup was compiled.
  void name_cells(const Snapshot<3>& snapshot);
  Delaunay::Cell_handle cell(Cell name) const { return cells_[to_index(name)]; }

 private:
  Delaunay delaunay_;
  Cell_soup<3> soup_;
  std::vector<Delaunay::Cell_handle> cells_;  // by index in the soup, then by name
};

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_TRIANGULATION_H
