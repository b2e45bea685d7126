// SPDX-License-Identifier: LGPL-3.0-or-later
// A body as plain data: vertices, the edges between them, and faces if it has a surface; made of polygons and
// segments, as files and generators provide them; and its placement.
#ifndef CELLWALK_RECORDS_BODY_SOUP_H
#define CELLWALK_RECORDS_BODY_SOUP_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// A body before it is placed in an environment. It may be open or closed, manifold or not, of one part or of
/// several. Vertices without edges and vertices with equal coordinates are allowed. `make_body` establishes
/// the properties of edges and faces below.
template <int D>
struct Body_soup {
  std::vector<Point<D>> points;                     ///< in the units of the environment
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< u < v; in ascending order, without repetition
  /// Triangles, each side of which is an edge; no two with the same three corners. 2D bodies have none.
  std::vector<std::array<std::uint32_t, 3>> faces;
  /// How far edges keep from every wall, finite and at least 0: none (0, they may touch walls), one for all
  /// edges and for vertices without edges, or one for each edge. See docs/radius.md.
  std::vector<double> radii = {};
};

/// The parts of a body. Polygons are loops of point indices; their sides and all segments become edges.
template <int D>
struct Body_parts {
  std::vector<Point<D>> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::array<std::uint32_t, 2>> segments;
  /// Of the segments, finite and at least 0: none, or one for each. An edge has the largest radius of its
  /// segments; a side of a polygon that is no segment has 0.
  std::vector<double> radii = {};
};

/// A body, and counts of the parts that were changed or omitted.
template <int D>
struct Made_body {
  Body_soup<D> body;
  std::size_t cut_polygons = 0;    ///< polygons of more than 3 corners, split into triangles along new edges
  std::size_t repeated_faces = 0;  ///< triangles omitted: an earlier one has the same corners, in any order
  std::size_t degenerate_faces = 0;  ///< triangles omitted: a corner occurs twice; their sides are kept
  std::size_t null_edges = 0;        ///< segments and sides omitted: from a point to itself
  std::size_t unused_points = 0;     ///< points without edges; they are vertices of the body nevertheless
};

/// Makes a body. Points and faces keep their order, faces their orientation.
///
/// In 3D a polygon is split into a fan of triangles from its corner of lowest index, so that a polygon shared
/// by two cells is split consistently; the diagonals become edges. A polygon of two corners is an edge, one
/// of one corner is ignored. In 2D a polygon contributes its sides only.
/// \throw Error(input) naming the point, polygon or segment: a coordinate that is not finite, an index out of
///        range, more points than 32-bit indices can address, a radius that is negative or not finite,
///        another number of radii than of segments
/// Cost: n log n in the number of sides.
template <int D>
Made_body<D> make_body(Body_parts<D> parts);

extern template Made_body<2> make_body(Body_parts<2>);
extern template Made_body<3> make_body(Body_parts<3>);

/// A rotation about the origin: in 2D counterclockwise, in 3D about an axis by the right-hand rule.
template <int D>
struct Rotation;
template <>
struct Rotation<2> {
  double degrees = 0;
};
template <>
struct Rotation<3> {
  Vector<3> axis{0, 0, 1};  ///< of any length except zero
  double degrees = 0;
};

/// The placement of a body: scaled, then rotated, both about the origin, then translated.
template <int D>
struct Body_placement {
  double scale = 1;
  Rotation<D> rotation{};
  Point<D> position{};  ///< of the origin of the body
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_BODY_SOUP_H
