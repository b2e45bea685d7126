// SPDX-License-Identifier: LGPL-3.0-or-later
// The shortest vector from the wall to what moves: the normal of a facet, the difference of nearest points,
// or the direction that is normal to both features.
#include "near_normal.h"

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cellwalk::detail {
namespace {

/// Radii that are a smaller part of coordinates lose too many digits in differences of points.
constexpr double least_part = 0x1p-12;

template <int D>
using Points = boost::container::small_vector<Point<D>, 8>;

template <int D>
double largest_coordinate(const Points<D>& points) {
  double most = 0;
  for (const Point<D>& x : points)
    for (const double c : x) most = std::max(most, std::abs(c));
  return most;
}

/// The normal of a facet on the side of the motion, which comes from there.
template <int D, class... P>
Vector<D> facet_normal(const Point<D>& from, const P&... corners) {
  Predicate_counts counts;
  const double sign = Exact::orientation(counts, corners..., from);
  return sign * unit_normal(corners...) + Vector<D>{};  // no negative zeros for readers of tables
}

/// A vector of any size, scaled to length 1.
template <int D>
Vector<D> scaled_to_1(Vector<D> v) {
  double largest = 0;
  for (const double x : v) largest = std::max(largest, std::abs(x));
  for (double& x : v) x /= largest;
  return normalized(v) + Vector<D>{};
}

}  // namespace

template <int D>
Near_place<D> find_near_place(const Thick_motion<D>& motion, std::span<const Point<D>> wall,
                              const Near_time& near, double time) {
  // The features; of the one that moves, the first corner goes from one place to another.
  const auto& [of_motion, of_wall] = std::tie(near.of_motion, near.of_wall);
  const std::array still{motion.p, motion.q.value_or(motion.p), motion.third.value_or(motion.p)};
  Points<D> moved, met;
  for (std::size_t i = 0; i < of_motion.size; ++i) moved.push_back(still[of_motion.corners[i]]);
  const bool is_moving = of_motion.corners[0] == 0;
  const Point<D> from = moved[0], target = is_moving ? motion.target : from;
  moved[0] = point_on<D>(from, target, time);
  const bool is_facet = of_wall.size == D;
  if (D == 3 && is_facet)
    met.assign(wall.begin(), wall.end());
  else
    for (std::size_t i = 0; i < of_wall.size; ++i) met.push_back(wall[of_wall.corners[i]]);
  const std::span<const Point<D>> features{met.data(), met.size()};
  const auto [pair, on_motion, on_wall] = nearest_in_doubles<D>({moved.data(), moved.size()}, features);
  if (is_facet) {
    const auto& k = of_wall.corners;
    if constexpr (D == 2)
      return {on_motion, on_wall, facet_normal<2>(motion.p, met[0], met[1])};
    else
      return {on_motion, on_wall, facet_normal<3>(motion.p, wall[k[0]], wall[k[1]], wall[k[2]])};
  }
  const double most = std::max(largest_coordinate<D>(moved), largest_coordinate<D>(met));
  if (motion.radius > least_part * most) return {on_motion, on_wall, scaled_to_1<D>(on_motion - on_wall)};
  return {on_motion, on_wall,
          common_normal<D>(from, target, time, {moved.data() + 1, moved.size() - 1}, features)};
}

template Near_place<2> find_near_place<2>(const Thick_motion<2>&, std::span<const Point<2>>, const Near_time&,
                                          double);
template Near_place<3> find_near_place<3>(const Thick_motion<3>&, std::span<const Point<3>>, const Near_time&,
                                          double);

}  // namespace cellwalk::detail
