// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that need no file. All but polylines have their centre at the origin. Coordinates are the same with
// every compiler and on every machine.
#ifndef CELLWALK_GENERATORS_BODY_SHAPES_H
#define CELLWALK_GENERATORS_BODY_SHAPES_H

#include <cellwalk/records/body_shape.h>
#include <cellwalk/records/body_soup.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// A body of more vertices is a mistake.
inline constexpr std::uint32_t most_generated_vertices = 1U << 24;

/// The paper's hexahedron: 8 vertices, 12 edges; with faces 18 edges, 12 triangles counterclockwise seen from
/// outside.
/// \throw Error(usage) unless the side is a positive number
Body_soup<3> generate_body(const Hexahedron_shape& shape);

/// The surface of a box; vertices in ascending order of z, then y, then x. With one cell along each axis the
/// numbering is that of the hexahedron.
/// \throw Error(usage) unless sizes and cells are positive and there are at most 2^24 vertices
Body_soup<3> generate_body(const Box_shape& shape);

/// 4 vertices, 6 edges, 4 triangles counterclockwise seen from outside.
/// \throw Error(usage) unless the side is positive
Body_soup<3> generate_body(const Tetrahedron_shape& shape);

/// 10 * 4^n + 2 vertices, 30 * 4^n edges, 20 * 4^n triangles counterclockwise seen from outside. Vertices are
/// at the radius but for rounding.
/// \throw Error(usage) unless the radius is positive and there are at most 10 subdivisions
Body_soup<3> generate_body(const Icosphere_shape& shape);

/// 3 vertices counterclockwise.
/// \throw Error(usage) unless the side is positive
Body_soup<2> generate_body(const Triangle_shape& shape);

/// 4 vertices counterclockwise from the lowest.
/// \throw Error(usage) unless the side is positive
Body_soup<2> generate_body(const Quad_shape& shape);

/// Vertices counterclockwise; each coordinate is the double nearest to that of the exact regular polygon.
/// \throw Error(usage) unless there are 3 to 2^24 corners and the radius is positive
Body_soup<2> generate_body(const Polygon_shape& shape);

/// \throw Error(usage) unless the length is positive and there are 2 to 2^24 vertices
template <int D>
Body_soup<D> generate_body(const Catheter_shape<D>& shape);

/// A polyline of one point is a single vertex.
/// \throw Error(usage) where there is no point, or one that is not finite
template <int D>
Body_soup<D> generate_body(const Polyline_shape<D>& shape);

/// A rope along a path: a polyline through all points of the path, whose edges are of equal length between
/// two of them, and at most as long as the spacing.
/// \throw Error(usage) where there is no point, or one that is not finite, unless the spacing is a positive
///        number, and for more than 2^24 vertices
template <int D = 3>
Body_soup<D> rope(const std::vector<Point<D>>& path, double spacing);

/// The body of any shape.
/// \throw Error(usage) as above
Body_soup<2> generate_body(const Body_shape<2>& shape);
Body_soup<3> generate_body(const Body_shape<3>& shape);

extern template Body_soup<2> generate_body(const Catheter_shape<2>&);
extern template Body_soup<3> generate_body(const Catheter_shape<3>&);
extern template Body_soup<2> generate_body(const Polyline_shape<2>&);
extern template Body_soup<3> generate_body(const Polyline_shape<3>&);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_BODY_SHAPES_H
