// SPDX-License-Identifier: LGPL-3.0-or-later
// Differences of corners span a simplex, which the method changes corner by corner. Each point of it is a
// difference of two points of the hulls, whatever rounding does to the weights of its corners.
#include "gjk.h"

#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

namespace cellwalk::detail {
namespace {

/// A step leads to a point that is less near by this part at least, in proportion to the square.
constexpr double least_progress = 0x1p-46;
constexpr int most_steps = 12;  // more are left to ring numbers

/// Some corners of the simplex, and the point of their hull that is nearest to the origin.
template <int D>
struct Face {
  boost::container::static_vector<Vector<D>, D> corners;
  Vector<D> nearest{};
};

template <int D>
Face<D> nearest_on(const Vector<D>& x) {
  return {{x}, x};
}

template <int D>
Face<D> nearest_on(const Vector<D>& x, const Vector<D>& y) {
  const Vector<D> d = y - x;
  const double t = -dot(x, d) / dot(d, d);
  if (!(t > 0)) return nearest_on<D>(x);
  if (t >= 1) return nearest_on<D>(y);
  return {{x, y}, x + t * d};
}

/// By the sides of the triangle that the origin lies on.
Face<3> nearest_on(const Vector<3>& x, const Vector<3>& y, const Vector<3>& z) {
  const Vector<3> d = y - x, e = z - x;
  const double xd = -dot(x, d), xe = -dot(x, e), yd = -dot(y, d), ye = -dot(y, e), zd = -dot(z, d),
               ze = -dot(z, e);
  const double of_z = xd * ye - yd * xe, of_y = zd * xe - xd * ze, of_x = yd * ze - zd * ye;
  const double sum = of_x + of_y + of_z;
  const double m = of_y / sum, l = of_z / sum;
  if (of_x > 0 && of_y > 0 && of_z > 0 && m + l <= 1 - 0x1p-50) return {{x, y, z}, (x + m * d) + l * e};
  Face<3> best = nearest_on<3>(z, x);
  for (const Face<3>& side : {nearest_on<3>(z, y), nearest_on<3>(x, y)})
    if (dot(side.nearest, side.nearest) < dot(best.nearest, best.nearest)) best = side;
  return best;
}

/// The nearest face of a simplex, among those that have its new corner.
template <int D>
Face<D> nearest_face(const boost::container::static_vector<Vector<D>, D>& old, const Vector<D>& x) {
  if (old.size() == 1) return nearest_on<D>(old[0], x);
  if constexpr (D == 3)
    if (old.size() == 2) return nearest_on(old[0], old[1], x);
  Face<D> best;
  for (std::size_t i = 0; i < D; ++i) {
    Face<D> face;
    if constexpr (D == 2)
      face = nearest_on<2>(old[i], x);
    else
      face = nearest_on(old[i], old[(i + 1) % 3], x);
    if (i == 0 || dot(face.nearest, face.nearest) < dot(best.nearest, best.nearest)) best = face;
  }
  return best;
}

template <int D>
Vector<D> farthest(std::span<const Vector<D>> points, const Vector<D>& along) {
  std::size_t best = 0;
  double most = dot(along, points[0]);
  for (std::size_t i = 1; i < points.size(); ++i)
    if (const double at = dot(along, points[i]); at > most) most = at, best = i;
  return points[best];
}

}  // namespace

template <int D>
Gjk_answer gjk(const Filter<D>& filter, std::span<const Point<D>> a, std::span<const Point<D>> b,
               Vector<D>& direction) {
  boost::container::small_vector<Vector<D>, 8> of_a, of_b;  // relative to the first corner of b
  for (const Point<D>& x : a) of_a.push_back(x - b[0]);
  for (const Point<D>& x : b) of_b.push_back(x - b[0]);
  Face<D> face = nearest_on<D>(of_a[0]);
  for (int step = 0; step < most_steps; ++step) {
    const Vector<D>& v = face.nearest;
    const double square = dot(v, v), size = std::sqrt(square);
    if (filter.are_near(size)) return Gjk_answer::near;
    const Vector<D> w =
        farthest<D>({of_a.data(), of_a.size()}, -1.0 * v) - farthest<D>({of_b.data(), of_b.size()}, v);
    const double along = dot(v, w);
    if (along > filter.radius() * size && filter.parts(v)) {
      direction = v;
      return Gjk_answer::apart;
    }
    if (!(square - along > least_progress * square)) break;
    face = nearest_face<D>(face.corners, w);
  }
  return Gjk_answer::open;
}

template Gjk_answer gjk<2>(const Filter<2>&, std::span<const Point<2>>, std::span<const Point<2>>,
                           Vector<2>&);
template Gjk_answer gjk<3>(const Filter<3>&, std::span<const Point<3>>, std::span<const Point<3>>,
                           Vector<3>&);

}  // namespace cellwalk::detail
