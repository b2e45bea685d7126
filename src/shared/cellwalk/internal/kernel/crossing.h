// SPDX-License-Identifier: LGPL-3.0-or-later
// Where a motion passes a line (2D) or plane (3D): its time in numbers of twice the precision of a double,
// whose error bound nearly always decides how it is rounded; exactly where it does not. Includes CGAL; users
// link CGAL::CGAL.
#ifndef CELLWALK_INTERNAL_KERNEL_CROSSING_H
#define CELLWALK_INTERNAL_KERNEL_CROSSING_H

#include <cellwalk/internal/kernel/exact_root.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/twofold.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <optional>
#include <variant>

namespace cellwalk {

/// The motion from a to b, and D points that span the line or plane it passes.
template <int D>
struct Crossing {
  Point<D> a, b;
  std::array<Point<D>, static_cast<std::size_t>(D)> plane;
};

/// The time at which the motion passes the plane: v_a / (v_a - v_b) for the orientations v_a of a and v_b of
/// b. None if their errors leave the sign of v_a undecided, or coordinates differ by less than 2^-150 or more
/// than 2^150.
/// \pre a and b do not lie strictly on the same side
template <int D>
std::optional<Bounded_twofold> bounded_time(const Crossing<D>& crossing);

/// \pre a and b do not both lie on the plane
template <int D>
Fraction fraction_of(const Crossing<D>& crossing);

/// \pre a and b lie strictly on different sides
/// Cost: 0.2 us, more if only exact arithmetic finds the greatest double that is not later.
template <int D>
Exact_time to_time(const Crossing<D>& crossing);

/// The time, rounded like the result of to_time(), in [0,1]; 0 and 1 only if exact.
/// \pre a and b do not lie strictly on the same side
template <int D>
double crossing_time(const Crossing<D>& crossing);

/// A time and where the motion is then.
template <int D>
struct Timed_point {
  double time;
  Point<D> point;
};

/// The crossing_time(), and the point with each coordinate rounded to within an ulp; exactly where the plane
/// is one of that coordinate.
/// \pre a and b do not lie strictly on the same side
template <int D>
Timed_point<D> timed_point(const Crossing<D>& crossing);

/// The number of an Exact_time: a fraction, the crossing from which that is computed once it is needed, or
/// the root of a polynomial, which need not be a fraction.
struct Exact_fraction {
  std::variant<Fraction, Crossing<2>, Crossing<3>, Exact_root> source;
};

/// For each coordinate of a point of a motion, the greatest double that is not above it, and the least that
/// is not below.
template <int D>
struct Point_bounds {
  Point<D> below, above;
};

/// The bounds of p + time (target - p); for a time that is one of two roots of a polynomial, those of the
/// point at the rounded time.
/// \pre the point is finite
template <int D>
Point_bounds<D> bounds_at(const Point<D>& p, const Point<D>& target, const Exact_time& time);
/// The bounds of the point where a motion passes a plane.
/// \pre a and b lie strictly on different sides
template <int D>
Point_bounds<D> bounds_at(const Crossing<D>& crossing);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_CROSSING_H
