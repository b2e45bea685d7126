// SPDX-License-Identifier: LGPL-3.0-or-later
// Orientations as exact numbers, for times of events. Includes CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_EXACT_VALUE_H
#define CELLWALK_INTERNAL_KERNEL_EXACT_VALUE_H

#include <cellwalk/kernel/exact.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Mpzf.h>

namespace cellwalk {

using Rational = CGAL::Exact_rational;

namespace detail {

/// The GMP number of a rational, for both wrappers that CGAL uses.
template <class R>
auto gmp_number(R& x) -> decltype(x.get_mpq_t()) {
  return x.get_mpq_t();
}
template <class R>
auto gmp_number(R& x) -> decltype(x.backend().data()) {
  return x.backend().data();
}

/// Exact numbers for sums, differences and products.
template <class Field>
struct Ring_of {
  using type = Field;
};

#ifdef CGAL_HAS_MPZF
/// Floats of any length, if rationals are those of GMP.
template <class Field>
requires requires(Field x, const CGAL::Mpzf& y) { y.export_to_mpq_t(gmp_number(x)); }
struct Ring_of<Field> {
  using type = CGAL::Mpzf;
};
#endif

}  // namespace detail

/// Ring numbers: they include all doubles; sums, differences and products are exact, and cheaper than those
/// of rationals.
using Ring = detail::Ring_of<Rational>::type;

/// The exact value of an orientation, that is its determinant, where the sign alone does not suffice.
struct Exact_value {
  static Ring orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r);
  static Ring orientation(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s);
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_EXACT_VALUE_H
