// SPDX-License-Identifier: LGPL-3.0-or-later
// Pairs of hulls: simplices, degenerate ones too, and convex polygons, on lattices where many distances are
// doubles, in general position, beside large walls, and at the ends of the range of doubles.
#ifndef CELLWALK_TESTS_KERNEL_HULL_PAIRS_H
#define CELLWALK_TESTS_KERNEL_HULL_PAIRS_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cellwalk::test {

/// How the points of a pair are placed.
enum class Placement {
  lattice,   ///< small integers
  turned,    ///< a lattice turned so that lengths of its axes are integers: distances are doubles obliquely
  generic,   ///< in general position
  wall_200,  ///< beside a wall that is some 200 times larger than what is near it
  wall_million,  ///< and 10^6 times
  huge,          ///< lattice times 2^1000
  tiny,          ///< lattice times 2^-1000
  subnormal,     ///< lattice times 2^-1074
  count
};
inline constexpr std::size_t placements = static_cast<std::size_t>(Placement::count);
inline constexpr std::array<const char*, placements> placement_names{
    "lattice", "turned", "generic", "wall 200", "wall 10^6", "huge", "tiny", "subnormal"};

template <int D>
struct Hull_pair {
  std::vector<Point<D>> a, b;
  double unit = 1;  ///< the size of a lattice step
};

template <int D>
class Pair_maker {
 public:
  explicit Pair_maker(std::uint64_t seed) : random_(seed) {}

  Hull_pair<D> make(Placement placement) {
    const bool is_lattice = placement != Placement::generic && placement != Placement::wall_200 &&
                            placement != Placement::wall_million;
    Hull_pair<D> pair;
    const double size = placement == Placement::wall_200       ? 200
                        : placement == Placement::wall_million ? 1e6
                                                               : 1;
    pair.a = simplex(is_lattice);
    pair.b = wall(is_lattice, size);
    if (placement == Placement::turned)
      for (auto* points : {&pair.a, &pair.b})
        for (Point<D>& x : *points) x = turned(x);
    if (placement == Placement::huge) pair.unit = 0x1p1000;
    if (placement == Placement::tiny) pair.unit = 0x1p-1000;
    if (placement == Placement::subnormal) pair.unit = 0x1p-1074;
    for (auto* points : {&pair.a, &pair.b})
      for (Point<D>& x : *points) x = pair.unit * x;
    return pair;
  }

  Random& random() { return random_; }

 private:
  double integer(int low, int high) { return low + static_cast<double>(random_.below(high - low + 1)); }

  Point<D> point(bool is_lattice) {
    Point<D> x;
    for (double& c : x) c = is_lattice ? integer(-4, 4) : random_.real(-2, 2);
    return x;
  }

  /// One to D+1 points; of every second set one repeats another, or lies in line or in the plane of others.
  std::vector<Point<D>> simplex(bool is_lattice) {
    std::vector<Point<D>> points(1 + random_.below(D + 1));
    for (Point<D>& x : points) x = point(is_lattice);
    const std::size_t n = points.size();
    if (is_lattice && random_.chance(0.4))
      for (std::size_t k = 1; k < n; ++k) points[k] = points[k - 1] + along(random_.below(D));
    if (n == 1 || random_.chance(0.5)) return points;
    Point<D>& last = points[n - 1];
    const auto k = static_cast<std::size_t>(random_.below(n - 1));
    if (n == 2 || random_.chance(0.3))
      last = points[k];
    else if (n == 3 || random_.chance(0.4))
      last = points[0] + integer(-1, 2) * (points[1] - points[0]);
    else
      last = points[0] + (points[1] - points[0]) + integer(-1, 1) * (points[2] - points[0]);
    return points;
  }

  /// A point, a segment, or (3D) a convex polygon with up to five vertices, of which the first three may be
  /// collinear.
  std::vector<Point<D>> wall(bool is_lattice, double size) {
    const Point<D> o = point(is_lattice);
    const std::size_t kind = random_.below(D == 2 ? 3 : 6);
    if (kind == 0) return {o};
    Vector<D> u, v{};
    const std::size_t axis = random_.below(D);
    if (is_lattice && random_.chance(0.5)) {
      u = along(axis);
      v = along((axis + 1) % D);
    } else {
      do {
        u = cut(size * point(is_lattice));
        if constexpr (D == 3) v = random_.chance(0.3) ? sidewards(u) : cut(size * point(is_lattice));
      } while (u == Vector<D>{} || (D == 3 && are_parallel(u, v)));
    }
    // A large wall reaches far on all sides of its point.
    const Point<D> start = cut(size > 1 ? o - random_.real(0.1, 0.4) * u - random_.real(0.1, 0.4) * v : o);
    if (D == 2 || kind == 1) return {start, start + u};
    static const std::array<std::vector<std::array<double, 2>>, 4> shapes{{
        {{0, 0}, {1, 0}, {0, 1}},
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
        {{0, 0}, {1, 0}, {2, 0}, {1, 2}, {0, 1}},
        {{0, 0}, {2, 0}, {1, 1}, {0, 1}},
    }};
    std::vector<Point<D>> polygon;
    for (const auto& [x, y] : shapes[kind - 2]) polygon.push_back(start + x * u + y * v);
    return polygon;
  }

  Vector<D> along(std::size_t axis) {
    Vector<D> u{};
    u[axis] = random_.chance(0.5) ? integer(1, 4) : integer(-4, -1);
    return u;
  }

  /// To multiples of 2^-20, so that sums are exact and corners coplanar.
  static Point<D> cut(Point<D> x) {
    for (double& c : x) c = std::floor(0x1p20 * c) * 0x1p-20;
    return x;
  }

  static Vector<D> sidewards(const Vector<D>& u) {
    if constexpr (D == 3)
      return {-u[1], u[0], 0};
    else
      return u;
  }

  static bool are_parallel(const Vector<D>& u, const Vector<D>& v) {
    if constexpr (D == 3)
      return cross(u, v) == Vector<3>{};
    else
      return false;
  }

  /// Three times (2D: five times) as far from the origin, exactly.
  static Point<D> turned(const Point<D>& x) {
    if constexpr (D == 3)
      return {2 * x[0] - 2 * x[1] + x[2], x[0] + 2 * x[1] + 2 * x[2], 2 * x[0] + x[1] - 2 * x[2]};
    else
      return {3 * x[0] - 4 * x[1], 4 * x[0] + 3 * x[1]};
  }

  Random random_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_KERNEL_HULL_PAIRS_H
