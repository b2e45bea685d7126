// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that are exactly plane, and swept triangles that meet them, miss them or touch them.
#ifndef CELLWALK_TESTS_EDGE_FLOOD_TRIANGLE_TRIALS_H
#define CELLWALK_TESTS_EDGE_FLOOD_TRIANGLE_TRIALS_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/environment/planes.h>
#include <cellwalk/internal/kernel/random.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "edge/rational_touch.h"

namespace cellwalk::test {

/// A convex facet, exactly plane, as the loop of its corners, and a swept triangle.
template <int D>
struct Triangle_trial {
  std::vector<Point<D>> loop;
  Swept_triangle<D> t{};
};

inline Point<3> in_space(const Point<3>& x) { return x; }
inline Point<3> in_space(const Point<2>& x) { return {x[0], x[1], 0}; }

/// True if closed triangle and closed facet share a point.
template <int D>
bool do_meet(const Triangle_trial<D>& x) {
  const auto meets = [&](std::vector<Point<3>> obstacle) {
    return touch_of_edge(in_space(x.t.a), in_space(x.t.b), in_space(x.t.q), obstacle).any();
  };
  if constexpr (D == 2) return meets({in_space(x.loop[0]), in_space(x.loop[1])});
  for (std::size_t k = 2; k < x.loop.size(); ++k)
    if (meets({in_space(x.loop[0]), in_space(x.loop[k - 1]), in_space(x.loop[k])})) return true;
  return false;
}

inline Vector<3> normal_of(const std::vector<Point<3>>& loop) {
  Vector<3> n{};
  for (std::size_t k = 2; k < loop.size(); ++k) n = n + cross(loop[k - 1] - loop[0], loop[k] - loop[0]);
  return n;
}
inline Vector<2> normal_of(const std::vector<Point<2>>& loop) {
  const Vector<2> d = loop[1] - loop[0];
  return {d[1], -d[0]};
}

/// The plane of a facet in one lane of a block; the other lanes are not used.
template <int D>
Plane_block<D> block_of(const std::vector<Point<D>>& loop, const Plane_frame<D>& frame, unsigned lane) {
  std::vector<Point<D>> mapped;
  for (const Point<D>& x : loop) mapped.push_back(frame.scale * (x - frame.centre));
  const Vector<D> n = normalized(normal_of(mapped));
  Plane_block<D> block{};
  block.offset = Float4{-1, -1, -1, -1};
  for (std::size_t k = 0; k < D; ++k) block.normal[k][lane] = static_cast<float>(n[k]);
  block.offset[lane] = static_cast<float>(-dot(n, mapped[0]));
  return block;
}

template <int D>
Point<D> any_point(Random& random, const Point<D>& centre, double most) {
  Point<D> x = centre;
  for (double& c : x) c += random.real(-most, most);
  return x;
}

/// A plane of small integers times a power of two, in which a polygon has integer coordinates: all its points
/// are exact.
class Exact_plane {
 public:
  Exact_plane(Random& random, double size, const Point<3>& centre) : size_(size), centre_(centre) {
    const double grid = size * 0x1p-20;
    for (double& c : centre_) c = std::round(c / grid) * grid;
    double across = 0;
    do {
      for (Vector<3>* x : {&u_, &v_})
        for (double& c : *x) c = std::round(random.real(-2048, 2048)) * 0x1p-11;
      across = length(cross(u_, v_));
    } while (!(across > 0.3));
  }
  /// A point by its coordinates, in parts of 512 of the size.
  Point<3> at(double i, double j) const {
    return centre_ + (size_ * std::round(i) * 0x1p-9) * u_ + (size_ * std::round(j) * 0x1p-9) * v_;
  }
  std::vector<Point<3>> polygon(Random& random, std::size_t corners) const {
    std::vector<Point<3>> loop;
    for (std::size_t k = 0; k < corners; ++k) {
      const double turn = (static_cast<double>(k) + random.real(-0.2, 0.2)) / static_cast<double>(corners);
      loop.push_back(
          at(512 * std::cos(2 * std::numbers::pi * turn), 512 * std::sin(2 * std::numbers::pi * turn)));
    }
    return loop;
  }

 private:
  double size_;
  Point<3> centre_;
  Vector<3> u_{}, v_{};
};

/// Sizes of facets and triangles, and where they are.
struct Kind {
  double facet, triangle, off_centre;
};

inline Triangle_trial<3> any_trial(Random& random, const Kind& kind, const Exact_plane& plane,
                                   const Point<3>& centre) {
  Triangle_trial<3> x;
  x.loop = plane.polygon(random, 3 + random.below(7));
  for (Point<3>* p : {&x.t.a, &x.t.b, &x.t.q}) *p = any_point<3>(random, centre, kind.triangle);
  return x;
}
inline Triangle_trial<3> any_trial(Random& random, const Kind& kind) {
  const Point<3> centre = any_point<3>(random, {}, kind.off_centre);
  return any_trial(random, kind, Exact_plane(random, kind.facet, centre), centre);
}
inline Triangle_trial<2> any_trial_2(Random& random, const Kind& kind) {
  const Point<2> centre = any_point<2>(random, {}, kind.off_centre);
  Triangle_trial<2> x;
  x.loop = {any_point<2>(random, centre, kind.facet), any_point<2>(random, centre, kind.facet)};
  for (Point<2>* p : {&x.t.a, &x.t.b, &x.t.q}) *p = any_point<2>(random, centre, kind.triangle);
  return x;
}

/// Has the triangle hold a point in a corner, on a side or inside.
inline void lead_through(Random& random, Swept_triangle<3>& t, const Point<3>& x) {
  switch (random.below(4)) {
    case 0:
      t.a = x;
      break;
    case 1:
      t.b = x + (x - t.a);
      break;
    case 2:
      t.q = x + (x - t.b);
      break;
    default:
      t.q = x + (x - 0.5 * (t.a + t.b));
  }
}

/// A point of a ridge of the facet, or a corner.
inline Point<3> on_ridge(Random& random, const std::vector<Point<3>>& loop) {
  const std::size_t k = random.below(loop.size());
  return loop[k] + static_cast<double>(random.below(5)) / 4 * (loop[(k + 1) % loop.size()] - loop[k]);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FLOOD_TRIANGLE_TRIALS_H
