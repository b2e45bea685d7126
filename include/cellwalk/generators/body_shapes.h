// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that need no file. All but polylines and ropes have their centre at the origin. Coordinates are the
// same with every compiler and on every machine.
#ifndef CELLWALK_GENERATORS_BODY_SHAPES_H
#define CELLWALK_GENERATORS_BODY_SHAPES_H

#include <cellwalk/records/body_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// A body of more vertices is a mistake.
inline constexpr std::uint32_t most_generated_vertices = 1U << 24;

/// The body of the paper's scenes (section IV): a cube of 8 vertices and 12 edges. Bit i of a vertex's index
/// gives its side along axis i; edges join vertex v to v^1, v^2 and v^4.
/// \param side the length of an edge
/// \param faces whether it has 12 triangles, counterclockwise seen from outside, and their 6 diagonals as
///        well
/// \throw Error(usage) unless the side is a positive number
Body_soup<3> hexahedron_body(double side, bool faces = false);

/// The surface of a box, with its sides divided into rectangles; vertices in ascending order of z, then y,
/// then x. With one cell along each axis the numbering is that of the hexahedron.
/// \param size of the box along each axis
/// \param cells rectangles along each axis
/// \param faces whether it has two triangles a rectangle, and their diagonal as well
/// \throw Error(usage) unless sizes and cells are positive and there are at most 2^24 vertices
Body_soup<3> box_body(const Vector<3>& size, const std::array<std::uint32_t, 3>& cells = {1, 1, 1},
                      bool faces = false);

/// A regular tetrahedron: 4 vertices, 6 edges, 4 triangles counterclockwise seen from outside.
/// \throw Error(usage) unless the side is positive
Body_soup<3> tetrahedron_body(double side);

/// An icosahedron whose triangles are repeatedly split into four and projected onto the sphere: after n
/// subdivisions 10 * 4^n + 2 vertices, 30 * 4^n edges, 20 * 4^n triangles counterclockwise seen from outside.
/// Vertices are at the radius but for rounding.
/// \throw Error(usage) unless the radius is positive and there are at most 10 subdivisions
Body_soup<3> icosphere_body(double radius, std::uint32_t subdivisions);

/// An equilateral triangle in 2D: 3 vertices counterclockwise.
/// \throw Error(usage) unless the side is positive
Body_soup<2> triangle_body(double side);

/// A square in 2D, the paper's quad, without diagonals: 4 vertices counterclockwise from the lowest.
/// \throw Error(usage) unless the side is positive
Body_soup<2> quad_body(double side);

/// A regular polygon in 2D; its first corner lies on the x axis. Vertices counterclockwise; each coordinate
/// is the double nearest to that of the exact regular polygon.
/// \throw Error(usage) unless there are 3 to 2^24 corners and the radius is positive
Body_soup<2> polygon_body(std::uint32_t corners, double radius);

/// A straight polyline along the x axis with vertices at equal distances.
/// \throw Error(usage) unless the length is positive and there are 2 to 2^24 vertices
template <int D>
Body_soup<D> catheter_body(double length, std::uint32_t vertices);

/// A polyline through given points; one point is a single vertex.
/// \throw Error(usage) where there is no point, or one that is not finite
template <int D>
Body_soup<D> polyline_body(const std::vector<Point<D>>& points);

/// A rope along a path: a polyline through all points of the path, whose edges are of equal length between
/// two of them, and at most as long as the spacing.
/// \throw Error(usage) where there is no point, or one that is not finite, unless the spacing is a positive
///        number, and for more than 2^24 vertices
template <int D = 3>
Body_soup<D> rope(const std::vector<Point<D>>& path, double spacing);

extern template Body_soup<2> catheter_body(double, std::uint32_t);
extern template Body_soup<3> catheter_body(double, std::uint32_t);
extern template Body_soup<2> polyline_body(const std::vector<Point<2>>&);
extern template Body_soup<3> polyline_body(const std::vector<Point<3>>&);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_BODY_SHAPES_H
