// SPDX-License-Identifier: LGPL-3.0-or-later
// Cuts of solid cells along a blade. Theory: docs/cutting.md.
#ifndef CELLWALK_RESHAPE_CUT_H
#define CELLWALK_RESHAPE_CUT_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// A surface along which solid cells are cut: triangles (2D: segments) whose sides agree, so that all are
/// counterclockwise seen from the same side.
template <int D>
struct Blade {
  using Piece = std::array<std::uint32_t, static_cast<std::size_t>(D)>;
  std::vector<Point<D>> points;
  std::vector<Piece> pieces;  ///< indices of points
};

/// The surface of a convex polygon, its corners in order around it (2D: a line through the points in order).
/// Corners may lie on its sides.
/// \throw Error(input) for fewer than 3 points (2D: 2), points that are not finite, and a polygon that is not
///        planar, not convex, without extent, or winds around more than once. Planes and sides are met up to
///        1e-9 of its size, and rounding of its coordinates; the rest is exact.
template <int D>
Blade<D> blade_along(std::span<const Point<D>> points);

/// The surface that a line through points in order sweeps.
/// \throw Error(input) for fewer than 2 points, points that are not finite, a displacement of no length, and
///        one along a piece of the line
Blade<3> swept_blade(std::span<const Point<3>> line, const Vector<3>& displacement);

template <int D>
struct Cut_options {
  /// How far the cells on the front of the blade are taken back at first, in lengths. Less where there is no
  /// room: then half of it, a quarter, and so on. Also the width of slits in membranes.
  double opening = 0.01;
  /// Where the blade passes an edge nearer to an end than this share of its length, the cut passes the end.
  double snap = 0.125;
};

/// A point that a cut made.
struct Cut_point {
  std::uint32_t point;
  /// It lies on the edge between these, at a share of it from the first; for one that was taken back from
  /// another, both are that.
  std::array<std::uint32_t, 2> between;
  double share;
};

/// The outcome of a cut. Of membranes, walls between free cells, edges count that cross a border of the slit.
struct Cut_report {
  std::size_t cells = 0;    ///< solid ones that the blade met: it passed an edge, or had a vertex
  std::size_t edges = 0;    ///< of solid cells that the blade passes, and of membranes
  std::size_t split = 0;    ///< of these
  std::size_t snapped = 0;  ///< of these, passed at an end
  std::size_t slit = 0;     ///< facets of membranes that were opened
  std::size_t facets = 0;   ///< of the cut
  std::size_t opened = 0;   ///< vertices of the cut that were parted
  std::size_t rim = 0;      ///< those at its rim inside solid cells, or on the boundary, which hold together
  std::size_t held = 0;     ///< those that could not be parted, as a cell would be flat
  std::vector<Cut_point> points;

  std::size_t refused() const { return edges - split - snapped; }
};

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_CUT_H
