// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact signs of orientations with bounds of their values, and bounds of the root between two of them.
#ifndef CELLWALK_INTERNAL_KERNEL_ORIENTATION_VALUE_H
#define CELLWALK_INTERNAL_KERNEL_ORIENTATION_VALUE_H

#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk {

/// The exact sign of an orientation, and bounds of its absolute value; the upper one is infinite if doubles
/// give none.
struct Orientation_value {
  int sign;
  double low, high;
};

/// Cost: that of an exact sign.
template <class... P>
Orientation_value orientation_value(Predicate_counts& counts, const P&... points) {
  ++counts.orientations;
  const auto d = detail::determinant<double>(points...);
  if (d.magnitude > detail::smallest_magnitude && d.magnitude < detail::largest_magnitude) {
    const double bound = detail::orientation_error * d.magnitude, size = std::abs(d.value);
    if (size > bound) return {detail::sign_of(d.value), size - bound, size + bound};
    ++counts.fallbacks;
    return {detail::orientation_cgal(points...), 0, size + bound};
  }
  ++counts.fallbacks;
  return {detail::orientation_cgal(points...), 0, std::numeric_limits<double>::infinity()};
}

struct Root_bounds {
  double low = 0, high = 1;
};

/// Bounds of the root |v_0| / (|v_0| + |v_1|) in (0,1) of an affine function with the values v_0 at 0 and v_1
/// at 1.
/// \pre the values have different signs
inline Root_bounds root_bounds(const Orientation_value& at_0, const Orientation_value& at_1) {
  // Rounding: one factor 1+u each in the bounds of the values, in their sum, in the quotient and in this
  // product; two of them occur in the numerator and the denominator. Together they are less than 8u.
  constexpr double rounding = 8 * 0x1p-53;
  // Quotients of values in the range of filtered magnitudes are far from 0 or rounded up to this.
  constexpr double smallest = 1e-290;
  Root_bounds bounds;
  const double largest = std::numeric_limits<double>::max();
  if (!(at_0.high < largest && at_1.high < largest)) return bounds;
  if (at_0.low > 0) bounds.low = at_0.low / (at_0.low + at_1.high) * (1 - rounding);
  if (at_1.low > 0)
    bounds.high = std::min(1.0, std::max(smallest, at_0.high / (at_0.high + at_1.low) * (1 + rounding)));
  return bounds;
}

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_ORIENTATION_VALUE_H
