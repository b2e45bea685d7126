// SPDX-License-Identifier: LGPL-3.0-or-later
// Shapes of bodies that need no file, and where a body is put.
#ifndef CELLWALK_RECORDS_BODY_SHAPE_H
#define CELLWALK_RECORDS_BODY_SHAPE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace cellwalk {

/// The body of the paper's scenes: a cube of 8 vertices. Bit i of a vertex's index says on which side it lies along axis i;
/// vertex v is joined to v^1, v^2 and v^4.
struct Hexahedron_shape {
  double side = 1;
  bool faces = false;  ///< 12 triangles and their 6 diagonals as well
};

/// The surface of a box, its sides cut into rectangles.
struct Box_shape {
  Vector<3> size{1, 1, 1};
  std::array<std::uint32_t, 3> cells{1, 1, 1};  ///< rectangles along each axis
  bool faces = false;                           ///< two triangles a rectangle and their diagonal as well
};

/// A regular tetrahedron with its four faces.
struct Tetrahedron_shape {
  double side = 1;
};

/// An icosahedron whose triangles were cut into four, so many times, and moved onto the sphere.
struct Icosphere_shape {
  double radius = 1;
  std::uint32_t subdivisions = 2;
};

/// An equilateral triangle of the plane.
struct Triangle_shape {
  double side = 1;
};

/// A square of the plane: the paper's quad, without diagonals.
struct Quad_shape {
  double side = 1;
};

/// A regular polygon of the plane; its first corner lies on the x axis.
struct Polygon_shape {
  std::uint32_t corners = 6;
  double radius = 1;  ///< from the centre to a corner
};

/// A straight catheter along the x axis: vertices at equal distances, each joined to the next.
template <int D>
struct Catheter_shape {
  double length = 1;
  std::uint32_t vertices = 20;
};

/// Points where they are, each joined to the next.
template <int D>
struct Polyline_shape {
  std::vector<Point<D>> points;
};

namespace detail {

template <int D>
struct Body_shapes;
template <>
struct Body_shapes<2> {
  using type = std::variant<Triangle_shape, Quad_shape, Polygon_shape, Catheter_shape<2>, Polyline_shape<2>>;
};
template <>
struct Body_shapes<3> {
  using type = std::variant<Hexahedron_shape, Box_shape, Tetrahedron_shape, Icosphere_shape,
                            Catheter_shape<3>, Polyline_shape<3>>;
};

}  // namespace detail

/// Any shape of a body of dimension D.
template <int D>
using Body_shape = typename detail::Body_shapes<D>::type;

/// A rotation about the origin; in the plane counterclockwise, in space about an axis by the right-hand rule.
template <int D>
struct Rotation;
template <>
struct Rotation<2> {
  double degrees = 0;
};
template <>
struct Rotation<3> {
  Vector<3> axis{0, 0, 1};  ///< of any length but zero
  double degrees = 0;
};

/// Where a body is put: scaled, then rotated, both about the origin, then moved.
template <int D>
struct Body_placement {
  double scale = 1;
  Rotation<D> rotation{};
  Point<D> position{};  ///< where the origin of the body comes to lie
};

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_BODY_SHAPE_H
