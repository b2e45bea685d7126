// SPDX-License-Identifier: LGPL-3.0-or-later
// The shortest vector from the wall to what moves: the normal of a facet, the difference of nearest points,
// or the direction that is normal to both features.
#include "near_normal.h"

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/exact.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>

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
  Points<D> moved{point_on<D>(motion.p, motion.target, time)}, still, met;
  if (near.body == Body_feature::edge) still.push_back(*motion.q);
  moved.insert(moved.end(), still.begin(), still.end());
  const auto& corners = near.of_wall.corners;
  const bool is_facet = near.of_wall.size == D;
  if (D == 3 && is_facet)
    met.assign(wall.begin(), wall.end());
  else
    for (std::size_t i = 0; i < near.of_wall.size; ++i) met.push_back(wall[corners[i]]);
  const std::span<const Point<D>> of_wall{met.data(), met.size()};
  const Nearest<D> nearest = nearest_in_doubles<D>({moved.data(), moved.size()}, of_wall);
  if (is_facet) {
    if constexpr (D == 2)
      return {nearest.on_b, facet_normal<2>(motion.p, met[0], met[1])};
    else
      return {nearest.on_b, facet_normal<3>(motion.p, wall[corners[0]], wall[corners[1]], wall[corners[2]])};
  }
  const double most = std::max(largest_coordinate<D>(moved), largest_coordinate<D>(met));
  if (motion.radius > least_part * most) return {nearest.on_b, scaled_to_1<D>(nearest.on_a - nearest.on_b)};
  return {nearest.on_b,
          common_normal<D>(motion.p, motion.target, time, {still.data(), still.size()}, of_wall)};
}

template Near_place<2> find_near_place<2>(const Thick_motion<2>&, std::span<const Point<2>>, const Near_time&,
                                          double);
template Near_place<3> find_near_place<3>(const Thick_motion<3>&, std::span<const Point<3>>, const Near_time&,
                                          double);

}  // namespace cellwalk::detail
