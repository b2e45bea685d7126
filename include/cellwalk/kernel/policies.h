// SPDX-License-Identifier: LGPL-3.0-or-later
// Number policies that Exact is compared with, by those who repeat the paper:
//
//   Lazy         CGAL's lazy exact kernel: always right; the reference for the cost of exactness
//   Unfiltered   rational arithmetic for every sign, without a filter: always right
//   Double       the sign of the rounded determinant: wrong near degeneracies
//   Tolerant     the same, but 0 within 10^-9
//   Scale_free   the same, but 0 within a share of its terms
//   Float        the rounded sign in single precision
#ifndef CELLWALK_KERNEL_POLICIES_H
#define CELLWALK_KERNEL_POLICIES_H

#include <cellwalk/kernel/exact.h>

#include <cmath>

namespace cellwalk {

namespace detail {

/// Exact sign by CGAL's lazy exact kernel.
int orientation_lazy(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_lazy(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);
/// Exact sign by rational numbers alone.
int orientation_rational(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_rational(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);

}  // namespace detail

/// Exact signs by CGAL's lazy exact kernel, without certificates.
struct Lazy {
  static constexpr bool is_exact = true;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "lazy";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return detail::orientation_lazy(points...);
  }
};

/// Exact signs in rational numbers, each computed in full.
/// Cost: some microseconds a sign.
struct Unfiltered {
  static constexpr bool is_exact = true;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "rational";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return detail::orientation_rational(points...);
  }
};

/// Rounded signs in double precision: misses walls near degeneracies.
struct Double {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "double";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return detail::sign_of(detail::determinant<double>(points...).value);
  }
};

/// Rounded signs in double precision that are 0 up to a fixed tolerance, as is common practice. It is one of
/// the area (2D) or volume (3D) of the determinant, so it depends on the scale of the input.
struct Tolerant {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr double tolerance = 1e-9;
  static constexpr const char* name = "double_1e-9";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    const double value = detail::determinant<double>(points...).value;
    return std::abs(value) <= tolerance ? 0 : detail::sign_of(value);
  }
};

/// Rounded signs in double precision that are 0 where rounding may have changed them: within 16 u (u = 2^-53)
/// of the sum of the sizes of the terms. So they do not depend on the scale of the input.
struct Scale_free {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "double_16u";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    const auto d = detail::determinant<double>(points...);
    return std::abs(d.value) <= detail::orientation_error * d.magnitude ? 0 : detail::sign_of(d.value);
  }
};

/// Rounded signs in single precision.
struct Float {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "float";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return detail::sign_of(detail::determinant<float>(points...).value);
  }
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_POLICIES_H
