// SPDX-License-Identifier: LGPL-3.0-or-later
// Where one facet lies over another one, and how far from it, in rounded arithmetic. Internal.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_COMMON_PART_H
#define CELLWALK_ENVIRONMENT_CERTIFY_COMMON_PART_H

#include <cellwalk/internal/kernel/box.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// The part of a facet that lies over or below another one, which is about as large as the unit.
template <int D>
struct Common_part {
  std::vector<Vector<D>> corners;  ///< relative to the first vertex of the other one
  int exponent = 0;                ///< of the unit, a power of 2
  double gap = 0;                  ///< the largest distance from the plane of the other one
};

/// Facets face each other if the cosine of their outer normals is below this.
inline constexpr double facing_cosine = -0.5;

/// How near facets within a box may be to be meant to touch: a share of its diagonal, a billionth unless
/// given, or the error of rounded coordinates if that is larger.
template <int D>
double facing_tolerance(const Box<D>& box, double share);
template <int D>
double facing_tolerance(const Box<D>& box);

/// The tolerance, or less for something small in this box.
template <int D>
double largest_gap(const Box<D>& box, double tolerance);

/// \param loop, normal a convex polygon and its outer normal
/// \param other the part of which
template <int D>
Common_part<D> common_part(std::span<const Point<D>> points, std::span<const std::uint32_t> loop,
                           const Vector<D>& normal, std::span<const std::uint32_t> other);

/// True if the other facet lies over a part of the first one that is wider than the largest_gap() of both,
/// within that distance.
template <int D>
bool is_near(std::span<const Point<D>> points, std::span<const std::uint32_t> loop, const Vector<D>& normal,
             std::span<const std::uint32_t> other, double tolerance);

/// The mean of the corners.
/// \param first vertex of the loop that it is a part over
template <int D>
std::vector<double> centre_of(const Common_part<D>& part, const Point<D>& first);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_COMMON_PART_H
