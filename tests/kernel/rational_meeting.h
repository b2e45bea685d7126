// SPDX-License-Identifier: LGPL-3.0-or-later
// A moving wall and what stands still, in rational arithmetic, by definition and without cells: shares
// nothing with the library.
#ifndef CELLWALK_TESTS_KERNEL_RATIONAL_MEETING_H
#define CELLWALK_TESTS_KERNEL_RATIONAL_MEETING_H

#include <cellwalk/kernel/point.h>

#include <boost/multiprecision/gmp.hpp>

#include <optional>
#include <span>
#include <sstream>

namespace cellwalk::test {

using Fraction = boost::multiprecision::mpq_rational;

/// A rational number of the library, by its text.
template <class Rational>
Fraction to_fraction(const Rational& x) {
  std::ostringstream text;
  text << x;
  return Fraction(text.str());
}

/// How a closed convex set meets a closed simplex, each spanned by points.
enum class Relation { apart, touch, hit };

/// The simplex is given by the start and the end of the corner that moves, and then its other corners; a set
/// by one point, two, or three (3D). A set hits a simplex of positive volume if it has a point inside it.
template <int D>
Relation relation(std::span<const Point<D>> simplex, std::span<const Point<D>> set);

/// The same, much faster: a simplex of positive volume clips the set.
template <int D>
Relation relation_by_clipping(std::span<const Point<D>> simplex, std::span<const Point<D>> set);

/// The infimum of the times at which the wall passes a point of the set, if it hits it.
template <int D>
std::optional<Fraction> first_time(std::span<const Point<D>> simplex, std::span<const Point<D>> set);

/// True if a set meets a simplex of positive volume elsewhere than in the wall as it starts.
template <int D>
bool meets_off_start(std::span<const Point<D>> simplex, std::span<const Point<D>> set);

/// The time in (0,1) at which a point that moves passes an inner point of a triangle; none if it does not, or
/// if it moves in the plane of that.
std::optional<Fraction> passing_time(const Point<3>& from, const Point<3>& to,
                                     std::span<const Point<3>> triangle);

/// Sign of the volume that D+1 points span.
template <int D>
int volume_sign(std::span<const Point<D>> points);

/// True if x lies in the relative interior of a simplex of dimension D-1.
template <int D>
bool lies_inside(std::span<const Point<D>> facet, const Point<D>& x);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_KERNEL_RATIONAL_MEETING_H
