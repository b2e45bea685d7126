// SPDX-License-Identifier: LGPL-3.0-or-later
// The open half-space before the plane of a wall, decided exactly: by floating-point numbers away from the
// plane, else by an orientation.
#ifndef CELLWALK_BODY_REGION_WALL_PLANE_H
#define CELLWALK_BODY_REGION_WALL_PLANE_H

#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "cut_plane.h"

namespace cellwalk::detail {

template <int D>
struct Wall_plane {
  Vector<D> normal{};  ///< outwards, rounded
  /// Of points of the box or the environment: where the product with the normal, as rounded, is less than
  /// `inside`, they lie before the plane; where it is greater than `outside`, they do not.
  double inside = 0, outside = 0;
  bool has_corners = false;  ///< false: there is no plane but `inside`
  std::array<Point<D>, D>
      corners;  ///< of the wall: copies, since edits elsewhere may move the points in memory

  Wall_plane() : corners{} {}
  /// \param sizes the largest size of each coordinate of points of the box and of the environment
  ///
  /// Rounding: a component n_k of the normal is a difference of two products of differences, and is off by
  /// less than 4u of the sum of their sizes, u = 2^-53; a product with a point is off by less than 3u of the
  /// sum of the sizes of its terms. So the value at x less the value at a corner c is off by less than 8u
  /// times the sum of T_k (|x_k| + |c_k|), T_k the sum of the sizes of the two products. The factor below is
  /// 32u, which covers the roundings of the bound.
  Wall_plane(const Cell_view<D>& cell, std::size_t i, const Point<D>& sizes) {
    const auto loop = cell.loop(i);
    has_corners = true;
    for (std::size_t k = 0; k < D; ++k) corners[k] = cell.point(loop[k]);
    const Point<D>& c = corners[0];
    Vector<D> terms{};
    const Vector<D> a = corners[1] - c;
    if constexpr (D == 2) {
      normal = {a[1], -a[0]};
      terms = {std::abs(a[1]), std::abs(a[0])};
    } else {
      const Vector<D> b = corners[2] - c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double first = a[(k + 1) % 3] * b[(k + 2) % 3], second = a[(k + 2) % 3] * b[(k + 1) % 3];
        normal[k] = first - second;
        terms[k] = std::abs(first) + std::abs(second) + least_magnitude;  // products may underflow
      }
    }
    double size = 0;
    for (std::size_t k = 0; k < D; ++k) size += terms[k] * (sizes[k] + std::abs(c[k]));
    const double error = 0x1p-48 * (size + least_magnitude);
    const double value = dot(normal, c);
    inside = value - error;
    outside = value + error;
    if (!(std::isfinite(inside) && std::isfinite(outside))) {
      inside = -std::numeric_limits<double>::infinity();
      outside = std::numeric_limits<double>::infinity();
    }
  }
  explicit Wall_plane(const Cut_plane<D>& plane)
      : normal(plane.normal),
        inside(plane.offset),
        outside(-std::numeric_limits<double>::infinity()),
        corners{} {}

  /// All that a copy has.
  template <class Archive>
  void archive(Archive& a) {
    a(normal, inside, outside, has_corners, corners);
  }

  /// True if a point of the box lies before the plane.
  bool has_before(const Point<D>& x) const {
    const double value = dot(normal, x);
    return value < inside || (value <= outside && side_of(x) < 0);
  }
  bool has_all_before(std::span<const Point<D>> points) const {
    return has_corners && std::ranges::all_of(points, [&](const Point<D>& x) { return has_before(x); });
  }
  /// True if a facet lies in the plane of the wall, or behind it.
  bool has_behind(const Cell_view<D>& cell, std::size_t i) const {
    return has_corners && std::ranges::all_of(cell.loop(i), [&](std::uint16_t v) {
             const Point<D>& x = cell.point(v);
             const double value = dot(normal, x);
             return value > outside || (value >= inside && side_of(x) >= 0);
           });
  }

 private:
  /// The side of any point: < 0 before the plane.
  /// \pre there are corners
  int side_of(const Point<D>& x) const {
    Predicate_counts counts;  // not those of walks
    if constexpr (D == 2)
      return -Exact::orientation(counts, corners[0], corners[1], x);
    else
      return Exact::orientation(counts, corners[0], corners[1], corners[2], x);
  }
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_WALL_PLANE_H
