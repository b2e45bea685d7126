// SPDX-License-Identifier: GPL-3.0-or-later
// A planar domain as triangles, by CGAL's constrained Delaunay triangulation.
#ifndef CELLWALK_MESHING_TRIANGULATE_H
#define CELLWALK_MESHING_TRIANGULATE_H

#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/surface_soup.h>

#include <cstddef>

namespace cellwalk {

struct Triangulate_options {
  bool keep_holes = false;  ///< true: triangles of holes are kept as solid cells; false: they are omitted
};

struct Triangulate_report {
  std::size_t merged_points = 0;     ///< points with the coordinates of another one
  std::size_t unused_points = 0;     ///< points of no segment, dropped
  std::size_t dropped_segments = 0;  ///< of length 0, or repeated
  std::size_t outer_holes = 0;       ///< points of holes that lie outside the domain, without effect
  std::size_t walls = 0;             ///< inner edges that are walls with free space on both sides
  std::size_t solid_cells = 0;       ///< with keep_holes
};

/// Triangulates the region enclosed by the segments of a domain, without the holes. Every segment becomes a
/// wall; a segment with free space on both sides becomes a membrane. No point is added.
/// \throw Error(input) if there are no segments, an index is out of range, a coordinate is not finite, two
///        segments cross (naming them), no region is enclosed, or a hole's point lies on a segment
/// Degenerate cases: a segment may end on another one, run through points, or overlap another one along a
/// line.
/// Cost: about 2 us a triangle.
Cell_soup<2> triangulate(const Planar_domain& domain, const Triangulate_options& options = {},
                         Triangulate_report* report = nullptr);

}  // namespace cellwalk

#endif  // CELLWALK_MESHING_TRIANGULATE_H
