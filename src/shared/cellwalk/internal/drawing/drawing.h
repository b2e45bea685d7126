// SPDX-License-Identifier: LGPL-3.0-or-later
// Shapes for drawings, as triangles.
#ifndef CELLWALK_INTERNAL_DRAWING_DRAWING_H
#define CELLWALK_INTERNAL_DRAWING_DRAWING_H

#include <cellwalk/internal/drawing/picture.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::drawing {

/// How many round shapes a drawing is to hold: balls or discs, pieces of tubes or flat lines, and the ends
/// of these.
struct Round_shapes {
  std::size_t balls = 0, pieces = 0, ends = 0;
};

/// About the number of triangles that they become with this number of sides (Drawing::sides).
/// \param flat as discs and flat lines
std::size_t triangles_of(const Round_shapes& shapes, int sides, bool flat);

/// The most sides with which they become at most `budget` triangles, finest_sides at most; the fewest there
/// are if none do. With few sides lines have no round ends: for lines about as wide as a pixel.
int sides_within(const Round_shapes& shapes, std::size_t budget, bool flat);

/// A ball.
void add_ball(Drawing& drawing, const Point<3>& centre, double radius, std::uint32_t material);

/// A round tube along a polyline, with round ends. Repeated points are skipped; a single point gives a ball.
void add_tube(Drawing& drawing, std::span<const Point<3>> line, double radius, std::uint32_t material);

/// An arrow from `tail` along `direction` (any length > 0), `length` long; its shaft has the given radius.
void add_arrow(Drawing& drawing, const Point<3>& tail, const Vector<3>& direction, double length,
               double radius, std::uint32_t material);

/// A surface of convex polygons (loops of point indices). Normals are averaged over facets around a point
/// that meet at less than `crease` degrees, so that a fine surface looks smooth and a box keeps its edges.
/// With crease 0 facets are flat.
void add_surface(Drawing& drawing, std::span<const Point<3>> points,
                 std::span<const std::vector<std::uint32_t>> facets, std::uint32_t material,
                 double crease = 45);

/// A flat line in the plane z = height, `width` wide, with round ends: for planar drawings.
void add_flat_line(Drawing& drawing, const Point<2>& a, const Point<2>& b, double width, double height,
                   std::uint32_t material);

/// A flat disc in the plane z = height.
void add_disc(Drawing& drawing, const Point<2>& centre, double radius, double height, std::uint32_t material);

/// A flat arrow in the plane z = height.
void add_flat_arrow(Drawing& drawing, const Point<2>& tail, const Vector<2>& direction, double length,
                    double width, double height, std::uint32_t material);

}  // namespace cellwalk::drawing

#endif  // CELLWALK_INTERNAL_DRAWING_DRAWING_H
