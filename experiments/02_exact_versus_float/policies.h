// SPDX-License-Identifier: LGPL-3.0-or-later
// Number policies of this experiment alone, beside those of <cellwalk/kernel/policies.h>.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_POLICIES_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_POLICIES_H

#include <cellwalk/kernel/exact.h>
#include <cellwalk/walk/strategy.h>

namespace cellwalk::exact_float {

/// Exact sign by CGAL's Exact_predicates_inexact_constructions_kernel.
int orientation_epick(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_epick(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);
/// Rounded sign by CGAL's Simple_cartesian<double>.
int orientation_cartesian(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_cartesian(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);
/// Rounded sign of a determinant in numbers of twice the precision of a double.
int orientation_twofold(const Point<2>& p, const Point<2>& q, const Point<2>& r);
int orientation_twofold(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);
/// The stages of Shewchuk's predicates after the first one: exact sign.
/// \param magnitude of the determinant, rounded
int adaptive_sign(double magnitude, const Point<2>& p, const Point<2>& q, const Point<2>& r);
int adaptive_sign(double magnitude, const Point<3>& p, const Point<3>& q, const Point<3>& r,
                  const Point<3>& s);

struct Epick {
  static constexpr bool is_exact = true;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "epick";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return orientation_epick(points...);
  }
};

/// Shewchuk's adaptive predicates ("Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", Discrete & Computational Geometry 18, 1997): as many stages as the sign needs, each of which
/// reuses the one before. Exact while no product overflows or underflows.
struct Adaptive {
  static constexpr bool is_exact = true;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "adaptive";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    constexpr double u = 0x1p-53;
    constexpr double first_error = sizeof...(P) == 3 ? (3 + 16 * u) * u : (7 + 56 * u) * u;
    const auto d = detail::determinant<double>(points...);
    const double bound = first_error * d.magnitude;
    if (d.value > bound) return 1;
    if (d.value < -bound) return -1;
    ++counts.fallbacks;
    return adaptive_sign(d.magnitude, points...);
  }
};

struct Cartesian {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "simple_cartesian";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return orientation_cartesian(points...);
  }
};

/// Rounded signs in the widest format of the machine: 64 binary places on x86-64.
struct Long_double {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "long_double";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return detail::sign_of(detail::determinant<long double>(points...).value);
  }
};

struct Double_double {
  static constexpr bool is_exact = false;
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "double_double";

  template <class... P>
  static int orientation(Predicate_counts& counts, const P&... points) {
    ++counts.orientations;
    return orientation_twofold(points...);
  }
};

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_POLICIES_H
