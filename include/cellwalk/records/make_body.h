// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons and segments, as files and generators have them, into a body.
#ifndef CELLWALK_RECORDS_MAKE_BODY_H
#define CELLWALK_RECORDS_MAKE_BODY_H

#include <cellwalk/records/body_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// What a body is made of. Polygons are loops of point indices; every side becomes an edge, as every segment does.
template <int D>
struct Body_parts {
  std::vector<Point<D>> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> segments;
};

/// A body, and what became of parts that do not appear in it as they were given.
template <int D>
struct Made_body {
  Body_soup<D> body;
  std::size_t cut_polygons = 0;    ///< polygons of more than 3 corners, cut into triangles along new edges
  std::size_t repeated_faces = 0;  ///< triangles left out: an earlier one has the same corners, in any order
  std::size_t degenerate_faces = 0;  ///< triangles left out: a corner occurs twice; their sides stay
  std::size_t null_edges = 0;        ///< segments and sides left out: from a point to itself
  std::size_t unused_points = 0;     ///< points on no edge; they are vertices of the body all the same
};

/// Makes a body. Points and faces keep their order, faces their orientation.
///
/// In space a polygon is cut into the triangles of a fan from its corner of lowest index, so that a polygon which two
/// cells share is cut alike from both; the diagonals become edges. A polygon of two corners is an edge, of one nothing.
/// In the plane a polygon contributes its sides only.
/// \throw Error(input) naming the point, polygon or segment: a coordinate that is not finite, an index out of range, more
///        points than 32-bit indices can name
/// Cost: n log n in the number of sides.
template <int D>
Made_body<D> make_body(Body_parts<D> parts);

extern template Made_body<2> make_body(Body_parts<2>);
extern template Made_body<3> make_body(Body_parts<3>);

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_MAKE_BODY_H
