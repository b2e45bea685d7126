// SPDX-License-Identifier: LGPL-3.0-or-later
// The number policy of the library. Every predicate is the sign of an orientation of input points, computed
// by a policy: Exact, one of <cellwalk/kernel/policies.h>, or your own (<cellwalk/walk/walk_impl.h>).
//
// Paper: section II (orientation tests of the particle walk). Sign convention is CGAL's:
//   orientation(p,q,r)   > 0  r lies to the left of the line pq (2D)
//   orientation(p,q,r,s) > 0  s lies on the side of plane pqr to which (q-p) x (r-p) points (3D)
#ifndef CELLWALK_KERNEL_EXACT_H
#define CELLWALK_KERNEL_EXACT_H

#include <cellwalk/internal/kernel/counts.h>
#include <cellwalk/internal/kernel/determinant.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace cellwalk {

namespace detail {

/// Exact sign by whole numbers, else by CGAL's filtered kernel; the slow path of Exact.
int orientation_cgal(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_cgal(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);

/// Relative error of a rounded difference of products in terms of its magnitude. With u = 2^-53 each
/// coordinate difference has a factor (1+u), each product and sum another: at most 7 factors in 3D and 4 in
/// 2D. The magnitude, with which the error is compared, is rounded down by as many. 16u covers both with a
/// margin.
inline constexpr double orientation_error = 16 * 0x1p-53;
/// Magnitudes outside this range are decided exactly. Below it an outer product may have underflowed (by
/// 2^-1075, far less than 16u times 1e-250); above it a term may have overflowed.
inline constexpr double smallest_magnitude = 1e-250;
inline constexpr double largest_magnitude = 1e+300;

}  // namespace detail

/// Counts of the signs that a policy computed, and of those that needed more than double arithmetic.
struct Predicate_counts {
  std::uint64_t orientations = 0;  ///< signs of orientations computed
  std::uint64_t fallbacks = 0;     ///< signs that the filter left undecided

  static constexpr std::array<std::string_view, 2> names{"orientations", "exact_fallbacks"};
};
static_assert(names_all_before<Predicate_counts>(sizeof(Predicate_counts)));

/// Exact signs at the cost of double arithmetic in nearly all cases. The default.
/// Cost: about 5 ns if the filter decides; else 30 to 70 ns some ulp off a plane, or in one if coordinates
/// along each axis are whole numbers below 2^60 in some unit, as in most meshes; to 10 us in other planes.
struct Exact {
  static constexpr bool is_exact = true;
  static constexpr bool uses_certificates = true;
  static constexpr const char* name = "exact";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    const auto d = detail::determinant<double>(points...);
    const double bound = detail::orientation_error * d.magnitude;
    // A NaN fails both comparisons and is decided below.
    if (d.magnitude > detail::smallest_magnitude && d.magnitude < detail::largest_magnitude) {
      if (d.value > bound) return 1;
      if (d.value < -bound) return -1;
    }
    ++counts.fallbacks;
    return detail::orientation_cgal(points...);
  }
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_EXACT_H
