// SPDX-License-Identifier: LGPL-3.0-or-later
// Orientations by each number policy, and points for which they are plainly 0.
#include <cellwalk/kernel/policies.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>

#include "integer_orientation.h"
#include "twofold_orientation.h"

namespace cellwalk::detail {
namespace {

template <class Kernel>
int orientation_in(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  using P = typename Kernel::Point_2;
  return CGAL::orientation(P(p[0], p[1]), P(q[0], q[1]), P(r[0], r[1]));
}

template <class Kernel>
int orientation_in(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  using P = typename Kernel::Point_3;
  return CGAL::orientation(P(p[0], p[1], p[2]), P(q[0], q[1], q[2]), P(r[0], r[1], r[2]),
                           P(s[0], s[1], s[2]));
}

template <class P>
bool have_coincident(const P&) {
  return false;
}
template <class P, class... Others>
bool have_coincident(const P& p, const Others&... others) {
  return ((others == p) || ...) || have_coincident(others...);
}

/// True if the points agree in a coordinate, or two of them coincide: then the orientation is 0. This is the
/// common case of bodies at walls that are parallel to the axes, and of walls that share a vertex.
template <std::size_t D, class... Others>
bool is_plainly_zero(const std::array<double, D>& p, const Others&... others) {
  for (std::size_t k = 0; k < D; ++k)
    if (((others[k] == p[k]) && ...)) return true;
  return have_coincident(p, others...);
}

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using Lazy_exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Rational_kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;

}  // namespace

int orientation_cgal(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  if (is_plainly_zero(p, q, r)) return 0;
  if (const auto sign = integer_orientation(p, q, r)) return *sign;
  const int sign = twofold_sign<2>({p, q}, r);
  return sign != 0 ? sign : orientation_in<Filtered>(p, q, r);
}

int orientation_cgal(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  if (is_plainly_zero(p, q, r, s)) return 0;
  if (const auto sign = integer_orientation(p, q, r, s)) return *sign;
  const int sign = twofold_sign<3>({p, q, r}, s);
  return sign != 0 ? sign : orientation_in<Filtered>(p, q, r, s);
}

int orientation_lazy(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return orientation_in<Lazy_exact>(p, q, r);
}

int orientation_lazy(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  return orientation_in<Lazy_exact>(p, q, r, s);
}

int orientation_rational(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return orientation_in<Rational_kernel>(p, q, r);
}

int orientation_rational(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  return orientation_in<Rational_kernel>(p, q, r, s);
}

}  // namespace cellwalk::detail
