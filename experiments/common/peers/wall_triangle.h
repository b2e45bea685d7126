// SPDX-License-Identifier: LGPL-3.0-or-later
// A segment against triangles in floating point, as fast as it goes: the planes are at hand, and hardly a
// segment gets past them. Wrong where rounding decides.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_TRIANGLE_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_TRIANGLE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cmath>

namespace cellwalk::experiments {

template <class Real>
struct Vector_of {
  Real x, y, z;
};
template <class Real>
inline Vector_of<Real> operator-(const Vector_of<Real>& a, const Vector_of<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
inline Real dot(const Vector_of<Real>& a, const Vector_of<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
inline Vector_of<Real> cross(const Vector_of<Real>& a, const Vector_of<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
inline Vector_of<Real> rounded(const Point<3>& p) {
  return {static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])};
}

/// A wall triangle and its plane.
template <class Real>
struct Wall_triangle {
  std::array<Vector_of<Real>, 3> corners;
  Vector_of<Real> normal;  ///< a unit vector
  Real offset;             ///< normal * x on the plane

  Wall_triangle(const Point<3>& a, const Point<3>& b, const Point<3>& c)
      : corners{rounded<Real>(a), rounded<Real>(b), rounded<Real>(c)},
        normal(cross(corners[1] - corners[0], corners[2] - corners[0])) {
    const Real length = std::sqrt(dot(normal, normal));
    normal = {normal.x / length, normal.y / length, normal.z / length};
    offset = dot(normal, corners[0]);
  }

  Real side(const Vector_of<Real>& p) const { return dot(normal, p) - offset; }

  /// True if the line of a and b passes through the triangle, its border included.
  bool is_on_line(const Vector_of<Real>& a, const Vector_of<Real>& b) const {
    const Vector_of<Real> d = b - a, u = corners[0] - a, v = corners[1] - a, w = corners[2] - a;
    const Real r = dot(d, cross(u, v)), s = dot(d, cross(v, w)), t = dot(d, cross(w, u));
    return (r >= 0 && s >= 0 && t >= 0) || (r <= 0 && s <= 0 && t <= 0);
  }
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_WALL_TRIANGLE_H
