// SPDX-License-Identifier: LGPL-3.0-or-later
// A facet clipped by the sides of another one, in units of that one's size.
#include "common_part.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

/// Of the diagonal: gaps of meshes whose points were rounded or written with few digits.
constexpr double near_share = 1e-9;
/// Of the largest coordinate: the error of a few roundings, where that is larger.
constexpr double rounding_share = 0x1p-49;
/// Facets are near within this share of the smaller one at most, so that not many are near one, however large
/// the tolerance is.
constexpr double largest_gap_share = 0x1p-6;

template <int D>
Box<D> box_of_loop(std::span<const Point<D>> points, std::span<const std::uint32_t> loop) {
  Box<D> box;
  for (const std::uint32_t v : loop) box.extend(points[v]);
  return box;
}

template <int D>
double longest_side(const Box<D>& box) {
  const Vector<D> sides = box.high - box.low;
  return *std::max_element(sides.begin(), sides.end());
}

/// The part of a convex polygon at which a linear function is at least 0.
template <int D>
std::vector<Vector<D>> cut_off(const std::vector<Vector<D>>& polygon, const Vector<D>& inwards,
                               const Vector<D>& from) {
  std::vector<Vector<D>> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = dot(inwards, p - from), at_q = dot(inwards, q - from);
    if (at_p >= 0) rest.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      rest.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
  return rest;
}

/// True if a convex polygon (2D: a segment, twice) is wider than a length.
template <int D>
bool is_wider(const std::vector<Vector<D>>& polygon, double width) {
  double perimeter = 0;
  Vector<3> doubled_area{};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    perimeter += length(q - p);
    if constexpr (D == 3) doubled_area = doubled_area + cross(p - polygon[0], q - polygon[0]);
  }
  // The area is at most the perimeter times the radius of the largest circle inside.
  return D == 2 ? perimeter > 4 * width : length(doubled_area) > 2 * width * perimeter;
}

}  // namespace

template <int D>
double facing_tolerance(const Box<D>& box, double share) {
  double largest = 0;
  for (std::size_t k = 0; k < D; ++k)
    largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
  const double tolerance = std::max(share * length(box.high - box.low), rounding_share * largest);
  return std::isfinite(tolerance) ? tolerance : 0;
}

template <int D>
double facing_tolerance(const Box<D>& box) {
  return facing_tolerance<D>(box, near_share);
}

template <int D>
double largest_gap(const Box<D>& box, double tolerance) {
  return std::min(tolerance, largest_gap_share * longest_side(box));
}

template <int D>
Common_part<D> common_part(std::span<const Point<D>> points, std::span<const std::uint32_t> loop,
                           const Vector<D>& normal, std::span<const std::uint32_t> other) {
  const double size = longest_side(box_of_loop<D>(points, loop));
  Common_part<D> part{{}, size > 0 && std::isfinite(size) ? std::ilogb(size) : 0, 0};
  const auto at = [&](std::uint32_t v) {
    Vector<D> x = points[v] - points[loop[0]];
    for (double& coordinate : x) coordinate = std::scalbn(coordinate, -part.exponent);
    return x;
  };
  for (const std::uint32_t v : other) part.corners.push_back(at(v));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector<D> p = at(loop[i]), q = at(loop[(i + 1) % loop.size()]);
    if constexpr (D == 2)
      part.corners = cut_off<2>(part.corners, q - p, p);
    else
      part.corners = cut_off<3>(part.corners, cross(normal, q - p), p);
  }
  double gap = 0;
  for (const Vector<D>& x : part.corners) gap = std::max(gap, std::abs(dot(normal, x)));
  part.gap = std::scalbn(gap, part.exponent);
  return part;
}

template <int D>
bool is_near(std::span<const Point<D>> points, std::span<const std::uint32_t> loop, const Vector<D>& normal,
             std::span<const std::uint32_t> other, double tolerance) {
  const Box<D> own = box_of_loop<D>(points, loop), box_of_other = box_of_loop<D>(points, other);
  const double gap = largest_gap<D>(own, tolerance);
  const double within = std::min(gap, largest_gap<D>(box_of_other, tolerance));
  const Vector<D> margin = with_all_coordinates<D>(gap);
  if (!Box<D>{own.low - margin, own.high + margin}.meets(box_of_other)) return false;
  // Most are seen to be apart by the heights of the corners above the plane.
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const std::uint32_t v : other) {
    const double height = dot(normal, points[v] - points[loop[0]]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (lowest > within || highest < -within) return false;
  const Common_part<D> part = common_part<D>(points, loop, normal, other);
  return part.gap <= within && is_wider<D>(part.corners, std::scalbn(within, -part.exponent));
}

template <int D>
std::vector<double> centre_of(const Common_part<D>& part, const Point<D>& first) {
  Vector<D> centre{};
  for (const Vector<D>& x : part.corners)
    centre = centre + (1 / static_cast<double>(part.corners.size())) * x;
  std::vector<double> place;
  for (std::size_t k = 0; k < D; ++k) place.push_back(first[k] + std::scalbn(centre[k], part.exponent));
  return place;
}

#define CELLWALK_INSTANTIATE(D)                                                                         \
  template double facing_tolerance(const Box<D>&, double);                                              \
  template double facing_tolerance(const Box<D>&);                                                      \
  template double largest_gap(const Box<D>&, double);                                                   \
  template Common_part<D> common_part(std::span<const Point<D>>, std::span<const std::uint32_t>,        \
                                      const Vector<D>&, std::span<const std::uint32_t>);                \
  template bool is_near<D>(std::span<const Point<D>>, std::span<const std::uint32_t>, const Vector<D>&, \
                           std::span<const std::uint32_t>, double);                                     \
  template std::vector<double> centre_of(const Common_part<D>&, const Point<D>&)
CELLWALK_INSTANTIATE(2);
CELLWALK_INSTANTIATE(3);
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
