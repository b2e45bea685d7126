// SPDX-License-Identifier: LGPL-3.0-or-later
// Shapes of bodies that scenes name.
#ifndef CELLWALK_INTERNAL_RECORDS_BODY_SHAPE_H
#define CELLWALK_INTERNAL_RECORDS_BODY_SHAPE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace cellwalk {

/// The body of the paper's scenes (section IV): a cube of 8 vertices. Bit i of a vertex's index gives its
/// side along axis i; edges join vertex v to v^1, v^2 and v^4.
struct Hexahedron_shape {
  double side = 1;
  bool faces = false;  ///< 12 triangles and their 6 diagonals as well
};

/// The surface of a box, with its sides divided into rectangles.
struct Box_shape {
  Vector<3> size{1, 1, 1};
  std::array<std::uint32_t, 3> cells{1, 1, 1};  ///< rectangles along each axis
  bool faces = false;                           ///< two triangles a rectangle and their diagonal as well
};

/// A regular tetrahedron with its four faces.
struct Tetrahedron_shape {
  double side = 1;
};

/// An icosphere: an icosahedron whose triangles are repeatedly split into four and projected onto the sphere.
struct Icosphere_shape {
  double radius = 1;
  std::uint32_t subdivisions = 2;
};

/// An equilateral triangle in 2D.
struct Triangle_shape {
  double side = 1;
};

/// A square in 2D: the paper's quad, without diagonals.
struct Quad_shape {
  double side = 1;
};

/// A regular polygon in 2D; its first corner lies on the x axis.
struct Polygon_shape {
  std::uint32_t corners = 6;
  double radius = 1;  ///< from the centre to a corner
};

/// A straight catheter along the x axis: a polyline with vertices at equal distances.
template <int D>
struct Catheter_shape {
  double length = 1;
  std::uint32_t vertices = 20;
};

/// A polyline through given points.
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

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_BODY_SHAPE_H
