// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact predicates and rounded exact values, derived from orientations.
#ifndef CELLWALK_INTERNAL_KERNEL_PREDICATES_H
#define CELLWALK_INTERNAL_KERNEL_PREDICATES_H

#include <cellwalk/kernel/point.h>

#include <span>

namespace cellwalk {

/// True if p, q and r are collinear (or two of them coincide).
bool are_collinear(const Point<2>& p, const Point<2>& q, const Point<2>& r);
bool are_collinear(const Point<3>& p, const Point<3>& q, const Point<3>& r);

/// True if x lies on the closed segment uv.
template <int D>
bool on_segment(const Point<D>& u, const Point<D>& v, const Point<D>& x);

/// True if x, a point of the plane of a convex polygon, lies in the closed polygon.
/// \pre the first three vertices of the polygon are not collinear
bool in_convex_polygon(std::span<const Point<3>> polygon, const Point<3>& x);

/// The side of the line pq (2D) or the plane pqr (3D) on which a point of it lies after a displacement by (e,
/// e^2, e^3) for arbitrarily small e > 0: the sign of orientation(p, q, x) or orientation(p, q, r, x) for the
/// displaced point x. It is 0 only if p and q coincide (3D: if p, q and r are collinear). This symbolic
/// perturbation chooses between the two sides of a wall if nothing else determines the side.
int displaced_side(const Point<2>& p, const Point<2>& q);
int displaced_side(const Point<3>& p, const Point<3>& q, const Point<3>& r);

/// Unit normal of the line uv (2D: on its left) or of the plane uvw (3D: on the side from which uvw is
/// counterclockwise). Each component is within 1e-14 of the exact one, for any scale and shape of the
/// triangle. The result is 0 if the points are collinear (2D: coincide).
Vector<2> unit_normal(const Point<2>& u, const Point<2>& v);
Vector<3> unit_normal(const Point<3>& u, const Point<3>& v, const Point<3>& w);

/// a + t (b - a), rounded; finite for all finite a and b and t in [0,1].
template <int D>
Point<D> point_on(const Point<D>& a, const Point<D>& b, double t);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_PREDICATES_H
