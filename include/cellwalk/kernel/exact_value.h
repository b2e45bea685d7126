// SPDX-License-Identifier: LGPL-3.0-or-later
// Orientations as exact numbers, for times of events. Includes CGAL; users link CGAL::CGAL.
#ifndef CELLWALK_KERNEL_EXACT_VALUE_H
#define CELLWALK_KERNEL_EXACT_VALUE_H

#include <cellwalk/kernel/exact_time.h>
#include <cellwalk/kernel/policies.h>

#include <CGAL/Exact_rational.h>

namespace cellwalk {

using Rational = CGAL::Exact_rational;

/// What an Exact_time holds.
struct Exact_fraction {
  Rational value;
};

/// \pre the fraction lies in the range of doubles
Exact_time to_time(const Rational& fraction);
Rational to_rational(const Exact_time& time);

/// Like a number policy, but orientation() is the determinant itself, not its sign.
struct Exact_value {
  static Rational orientation(Predicate_counts&, const Point<2>& p, const Point<2>& q, const Point<2>& r);
  static Rational orientation(Predicate_counts&, const Point<3>& p, const Point<3>& q, const Point<3>& r,
                              const Point<3>& s);
};

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_EXACT_VALUE_H
