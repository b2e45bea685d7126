// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether two convex hulls of a few points are a distance apart, decided exactly: the one predicate of bodies
// with a radius. Theory: docs/radius.md.
#ifndef CELLWALK_INTERNAL_KERNEL_DISTANCE_H
#define CELLWALK_INTERNAL_KERNEL_DISTANCE_H

#include <cellwalk/internal/kernel/counts.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace cellwalk {

/// The decisions of is_apart(), by the first stage that was certain.
struct Distance_counts {
  std::uint64_t boxes = 0;      ///< by the boxes of both hulls
  std::uint64_t planes = 0;     ///< by the direction that was given, or the plane of the wall
  std::uint64_t gjk = 0;        ///< by a direction that the method of Gilbert, Johnson and Keerthi finds
  std::uint64_t near = 0;       ///< by two points nearer than r that it finds
  std::uint64_t ring_pair = 0;  ///< by the nearest features, in ring numbers
  std::uint64_t ring_list = 0;  ///< by all directions, in ring numbers

  static constexpr std::array<std::string_view, 6> names{"boxes", "planes",    "gjk",
                                                         "near",  "ring_pair", "ring_list"};
};
static_assert(names_all_before<Distance_counts>(sizeof(Distance_counts)));

namespace detail {

/// A feature of a hull: the hull of `size` of its corners, at these positions.
struct Feature {
  std::array<std::uint16_t, 3> corners{};
  std::uint8_t size = 0;  ///< 1 vertex, 2 edge, 3 facet; 0: none

  bool operator==(const Feature&) const = default;
};

inline Feature vertex_feature(std::size_t i) { return {{static_cast<std::uint16_t>(i), 0, 0}, 1}; }
inline Feature edge_feature(std::size_t i, std::size_t j) {
  return {{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j), 0}, 2};
}
inline Feature facet_feature(std::size_t i, std::size_t j, std::size_t k) {
  return {{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j), static_cast<std::uint16_t>(k)}, 3};
}

/// A feature of each of two hulls, between which they are nearest: together of dimension D - 1 at most.
struct Feature_pair {
  Feature a, b;
};

/// A wall along a direction, measured once for many tests in doubles of whether the direction parts it from
/// others. The bounds are those of is_apart(), see filter.h of the kernel.
template <int D>
class Parting_direction {
 public:
  /// That parts nothing.
  Parting_direction() = default;
  /// \param wall as `b` of is_apart(), at least one corner
  /// \param direction of any length; one of 0 parts nothing
  Parting_direction(std::span<const Point<D>> wall, const Vector<D>& direction);
  /// True proves that the hull of some points is more than r away from the wall.
  bool parts(std::span<const Point<D>> points, double r) const {
    double low = std::numeric_limits<double>::infinity(), high = -low, extent = extent_;
    for (const Point<D>& x : points) {
      const Vector<D> from_origin = x - origin_;
      const double at = dot(direction_, from_origin);
      low = std::min(low, at), high = std::max(high, at);
      for (const double c : from_origin) extent = std::max(extent, std::abs(c));
    }
    return std::max(low - high_, low_ - high) - 0x1p-48 * extent > r && extent < 0x1p400;
  }
  const Vector<D>& direction() const { return direction_; }

 private:
  Point<D> origin_{};
  Vector<D> direction_{};                                    ///< scaled to a length just below 1
  double low_ = 0, high_ = 0;                                ///< of the corners along it
  double extent_ = std::numeric_limits<double>::infinity();  ///< of the corners around the origin
};

/// Is the distance of two hulls at least r? Exact in every position.
/// \param a the corners of a simplex: a point, an edge, a triangle or (3D) a tetrahedron; it may be
///        degenerate
/// \param b a point, the two ends of a segment, or (3D) the vertices of a convex polygon in order, of which
///        three need not be collinear first
/// \param r finite, greater than 0
/// \param direction along which the hulls may be apart, or 0: it is tried first. Takes one of any length
///        along which they are, if doubles find one
/// \param counts raised by the test
/// \pre all coordinates are finite
/// Cost: 30 to 40 ns where boxes or a known direction decide, up to 0.7 us near r, 3 to 6 us within some ulp
/// of r, where ring numbers decide; more where the nearest features are others than those that doubles found.
template <int D>
bool is_apart(std::span<const Point<D>> a, std::span<const Point<D>> b, double r, Vector<D>& direction,
              Distance_counts& counts);

/// The same for what an edge or face has swept at a time: the hull of the points `still` and of the way from
/// `from` to that time's point of the motion to `target`, which need not be a double.
/// \param still at most two points
/// \param time in [0,1]
/// Cost: ring numbers.
template <int D>
bool is_apart_until(const Point<D>& from, const Point<D>& target, std::span<const Point<D>> still,
                    double time, std::span<const Point<D>> b, double r);

/// The unit vector from one flat feature to another that is normal to both, where they are nearest: from `b`
/// to the hull of that point of a motion and of `still`.
/// \param still up to two points, not collinear with that of the motion then
/// \param b one or two points, one if there are two still ones
/// \pre the features do not meet; if both are edges, they are not parallel
/// Cost: ring numbers. Exact but for the rounding of the result.
template <int D>
Vector<D> common_normal(const Point<D>& from, const Point<D>& target, double time,
                        std::span<const Point<D>> still, std::span<const Point<D>> b);

/// Nearest points of two hulls, in doubles.
template <int D>
struct Nearest {
  Feature_pair features;
  Point<D> on_a{}, on_b{};
};

/// \pre as is_apart()
/// Degenerate cases: of several pairs at the same distance, one; hulls that meet may have any.
template <int D>
Nearest<D> nearest_in_doubles(std::span<const Point<D>> a, std::span<const Point<D>> b);

/// A lower bound of the distance of two hulls, at least 0: below it by less than 2^-40 of the largest
/// difference of coordinates.
/// Cost: that of is_apart() near r; some tests in ring numbers where rounding hides the direction, as between
/// edges that are nearly parallel.
template <int D>
double distance_bound(std::span<const Point<D>> a, std::span<const Point<D>> b);

/// The greatest double that is not above the distance of two hulls.
/// Cost: some tests in ring numbers.
template <int D>
double distance_rounded_down(std::span<const Point<D>> a, std::span<const Point<D>> b);

}  // namespace detail
}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_DISTANCE_H
