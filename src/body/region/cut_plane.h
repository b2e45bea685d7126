// SPDX-License-Identifier: LGPL-3.0-or-later
// Half-spaces that facets cut off, in rounded arithmetic with bounds: whatever is rounded, none of the facet
// is left.
#ifndef CELLWALK_BODY_REGION_CUT_PLANE_H
#define CELLWALK_BODY_REGION_CUT_PLANE_H

#include <cellwalk/environment/snapshot.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace cellwalk::detail {

/// A half-space without a wall: the exact product of its points with the normal is less than the limit; where
/// the product as rounded is less than the offset, for points of the box, it is.
template <int D>
struct Cut_plane {
  Vector<D> normal{};
  double limit = 0, offset = 0;
};

/// A scalar product is rounded by less than this part of the sum of the sizes of its terms: each is rounded
/// at most D times, by 2^-53, and so is the sum of their sizes.
constexpr double product_error = 0x1p-50;
/// And by less than product_error of this where a term underflows.
constexpr double least_magnitude = 1e-290;

/// The sum of the sizes of the terms of a product.
template <int D>
double magnitude(const Vector<D>& normal, const Point<D>& x) {
  double sum = 0;
  for (std::size_t k = 0; k < D; ++k) sum += std::abs(normal[k] * x[k]);
  return sum;
}
/// A lower bound of a product.
template <int D>
double least_product(const Vector<D>& normal, const Point<D>& x) {
  const double bound = dot(normal, x) - product_error * (magnitude<D>(normal, x) + least_magnitude);
  return std::isfinite(bound) ? bound : -std::numeric_limits<double>::infinity();
}

/// A normal of a facet, outwards, rounded.
template <int D>
Vector<D> outward(const Cell_view<D>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const Point<D>& u = cell.point(loop[0]);
  const Vector<D> edge = cell.point(loop[1]) - u;
  if constexpr (D == 2)
    return {edge[1], -edge[0]};
  else
    return cross(edge, cell.point(loop[2]) - u);
}

/// The half-space before a facet in a direction, made smaller by the bound of the rounding. None if nothing
/// is certain.
/// \param sizes the largest size of each coordinate of points to be tested
template <int D>
std::optional<Cut_plane<D>> plane_before(const Cell_view<D>& cell, std::size_t i, const Vector<D>& normal,
                                         const Point<D>& sizes) {
  const auto loop = cell.loop(i);
  Cut_plane<D> plane{normal, std::numeric_limits<double>::infinity(), 0};
  for (const std::uint16_t v : loop)
    plane.limit = std::min(plane.limit, least_product<D>(plane.normal, cell.point(v)));
  const double error = product_error * (magnitude<D>(plane.normal, sizes) + least_magnitude);
  plane.offset = plane.limit - error;
  // The difference is rounded, too.
  plane.offset -= product_error * std::abs(plane.offset);
  if (!std::isfinite(plane.offset)) return {};
  return plane;
}

/// True if a facet lies beyond a half-space in which the region lies.
template <int D>
bool is_beyond(const Cut_plane<D>& plane, const Cell_view<D>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  return std::all_of(loop.begin(), loop.end(), [&](std::uint16_t v) {
    return least_product<D>(plane.normal, cell.point(v)) >= plane.limit;
  });
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_CUT_PLANE_H
