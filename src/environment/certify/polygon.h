// SPDX-License-Identifier: LGPL-3.0-or-later
// Signs of polygons, in 2D and in planes in 3D. Internal to certification and splitting.
//
// A polygon in a plane in 3D is decided in 2D: a coordinate is dropped such that the projection of the plane
// is one-to-one; then every sign in the plane is the projected one up to a common factor.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_POLYGON_H
#define CELLWALK_ENVIRONMENT_CERTIFY_POLYGON_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/kernel/exact.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace cellwalk::detail {

/// Points of one facet or cell; on the stack for usual sizes.
template <int D>
using Polygon = boost::container::small_vector<Point<D>, 12>;

/// Drops a coordinate. The other two keep their cyclic order, so that a projected turn has the sign of that
/// component of the normal.
inline Point<2> drop(const Point<3>& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

template <class Points>
Polygon<2> drop(const Points& polygon, int axis) {
  Polygon<2> flat;
  flat.reserve(polygon.size());
  for (const Point<3>& p : polygon) flat.push_back(drop(p, axis));
  return flat;
}

inline int turn(Predicate_counts& counts, const Point<3>& p, const Point<3>& q, const Point<3>& r, int axis) {
  return Exact::orientation(counts, drop(p, axis), drop(q, axis), drop(r, axis));
}

/// An axis along which triangle pqr projects to one of positive area; -1 if the points are collinear.
int projection_axis(Predicate_counts& counts, const Point<3>& p, const Point<3>& q, const Point<3>& r);

/// Three vertices of a polygon, ascending, that are not collinear, and an axis of projection.
struct Corners {
  std::array<std::size_t, 3> at{};
  int axis = -1;
};

/// False if all vertices are collinear.
bool find_corners(Predicate_counts& counts, std::span<const Point<3>> polygon, Corners& corners);

/// True if all vertices lie in the plane of the corners.
bool is_planar(Predicate_counts& counts, std::span<const Point<3>> polygon, const Corners& corners);

/// +1 or -1 if the closed polygon is convex and turns exactly once, to the left or to the right; otherwise 0.
/// Vertices inside a straight side are allowed, spikes and repeated vertices are not.
int convex_turn(Predicate_counts& counts, std::span<const Point<2>> polygon);

/// True if two convex 2D polygons, both turning in direction `sign`, have disjoint interiors.
bool are_apart(Predicate_counts& counts, std::span<const Point<2>> a, std::span<const Point<2>> b, int sign);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_POLYGON_H
