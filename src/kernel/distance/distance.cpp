// SPDX-License-Identifier: LGPL-3.0-or-later
// The stages of is_apart(): boxes, a direction that is known, the search for one in doubles, ring numbers.
#include <cellwalk/internal/kernel/direction_at_distance.h>
#include <cellwalk/internal/kernel/greatest_double.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <limits>

#include "filter.h"
#include "gjk.h"
#include "ring_hulls.h"

namespace cellwalk::detail {
namespace {

/// The normal of the plane of a wall (2D: of its line), of any length; 0 if it has too few corners.
template <int D>
Vector<D> plane_normal(std::span<const Point<D>> wall) {
  if (wall.size() < D) return {};
  return direction_of<double, D>({wall, wall},
                                 {vertex_feature(0), D == 2 ? edge_feature(0, 1) : facet_feature(0, 1, 2)});
}

/// \param nearest of the hulls in doubles; only the time depends on it
template <int D>
bool decide(const Ring_hulls<D>& hulls, const Feature_pair& nearest, Distance_counts& counts) {
  ++counts.ring_pair;
  if (hulls.parts(nearest)) return true;
  if (hulls.are_near(nearest)) return false;
  --counts.ring_pair;
  ++counts.ring_list;
  return hulls.are_parted();
}

template <int D>
typename Ring_hulls<D>::Corners ring_corners(std::span<const Point<D>> points) {
  typename Ring_hulls<D>::Corners corners;
  for (const Point<D>& x : points) corners.push_back(in_ring<D>(x));
  return corners;
}

/// The point of a motion at a time.
template <int D>
typename Ring_hulls<D>::Corner ring_point(const Point<D>& from, const Point<D>& target, double time) {
  typename Ring_hulls<D>::Corner x = in_ring<D>(from);
  for (std::size_t k = 0; k < D; ++k) x[k] = Ring(x[k] + Ring(time) * Ring(Ring(target[k]) - x[k]));
  return x;
}

}  // namespace

template <int D>
Parting_direction<D>::Parting_direction(std::span<const Point<D>> wall, const Vector<D>& direction)
    : origin_(wall[0]) {
  double extent = 0;
  for (const Point<D>& x : wall)
    for (std::size_t k = 0; k < D; ++k) extent = std::max(extent, std::abs(x[k] - origin_[k]));
  const std::optional<Vector<D>> scaled = scaled_direction<D>(direction);
  if (!scaled || !(extent > 0x1p-400)) return;
  direction_ = *scaled;
  extent_ = extent;
  for (const Point<D>& x : wall) {
    const double at = dot(direction_, x - origin_);
    low_ = std::min(low_, at), high_ = std::max(high_, at);
  }
}

template class Parting_direction<2>;
template class Parting_direction<3>;

template <int D>
bool is_apart(std::span<const Point<D>> a, std::span<const Point<D>> b, double r, Vector<D>& direction,
              Distance_counts& counts) {
  const Filter<D> filter(a, b, r);
  if (filter.boxes_part()) {
    ++counts.boxes;
    return true;
  }
  if (filter.is_in_range()) {
    if (filter.parts(direction)) {
      ++counts.planes;
      return true;
    }
    if (const Vector<D> normal = plane_normal<D>(b); filter.parts(normal)) {
      ++counts.planes;
      direction = normal;
      return true;
    }
    switch (gjk<D>(filter, a, b, direction)) {
      case Gjk_answer::near:
        ++counts.near;
        return false;
      case Gjk_answer::apart:
        ++counts.gjk;
        return true;
      case Gjk_answer::open:
        break;
    }
  }
  return decide(Ring_hulls<D>(ring_corners<D>(a), b, r), nearest_features<D>(a, b).features, counts);
}

template bool is_apart<2>(std::span<const Point<2>>, std::span<const Point<2>>, double, Vector<2>&,
                          Distance_counts&);
template bool is_apart<3>(std::span<const Point<3>>, std::span<const Point<3>>, double, Vector<3>&,
                          Distance_counts&);

template <int D>
bool is_apart_until(const Point<D>& from, const Point<D>& target, std::span<const Point<D>> still,
                    double time, std::span<const Point<D>> b, double r) {
  boost::container::small_vector<Point<D>, 4> rounded{from, point_on<D>(from, target, time)};
  rounded.insert(rounded.end(), still.begin(), still.end());
  typename Ring_hulls<D>::Corners corners = ring_corners<D>({rounded.data(), rounded.size()});
  corners[1] = ring_point<D>(from, target, time);
  Distance_counts counts;
  return decide(Ring_hulls<D>(std::move(corners), b, r),
                nearest_features<D>({rounded.data(), rounded.size()}, b).features, counts);
}

template bool is_apart_until<2>(const Point<2>&, const Point<2>&, std::span<const Point<2>>, double,
                                std::span<const Point<2>>, double);
template bool is_apart_until<3>(const Point<3>&, const Point<3>&, std::span<const Point<3>>, double,
                                std::span<const Point<3>>, double);

template <int D>
Vector<D> common_normal(const Point<D>& from, const Point<D>& target, double time,
                        std::span<const Point<D>> still, std::span<const Point<D>> b) {
  typename Ring_hulls<D>::Corners of_a{ring_point<D>(from, target, time)}, of_b = ring_corners<D>(b);
  for (const Point<D>& x : still) of_a.push_back(in_ring<D>(x));
  const Hulls<Ring, D> hulls{{of_a.data(), of_a.size()}, {of_b.data(), of_b.size()}};
  const auto all_of = [](std::size_t size) {
    return size == 1 ? vertex_feature(0) : size == 2 ? edge_feature(0, 1) : facet_feature(0, 1, 2);
  };
  const auto n = direction_of<Ring, D>(hulls, {all_of(of_a.size()), all_of(of_b.size())});
  const bool leads_to_a = CGAL::sign(product(n, difference(of_a[0], of_b[0]))) == CGAL::POSITIVE;
  Ring largest(0);
  for (const Ring& x : n) {
    const Ring size(CGAL::sign(x) == CGAL::NEGATIVE ? Ring(-x) : x);
    if (largest < size) largest = size;
  }
  Vector<D> scaled;
  for (std::size_t k = 0; k < D; ++k)
    scaled[k] = to_double(Fraction(leads_to_a ? n[k] : Ring(-n[k]), largest));
  return normalized(scaled);
}

template Vector<2> common_normal<2>(const Point<2>&, const Point<2>&, double, std::span<const Point<2>>,
                                    std::span<const Point<2>>);
template Vector<3> common_normal<3>(const Point<3>&, const Point<3>&, double, std::span<const Point<3>>,
                                    std::span<const Point<3>>);

template <int D>
double distance_rounded_down(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  Vector<D> direction{};
  Distance_counts counts;
  const auto holds = [&](double r) { return is_apart<D>(a, b, r, direction, counts); };
  if (!holds(std::numeric_limits<double>::denorm_min())) return 0;  // hulls that meet
  return greatest_double(nearest_features<D>(a, b).distance, std::numeric_limits<double>::max(), holds);
}

template double distance_rounded_down<2>(std::span<const Point<2>>, std::span<const Point<2>>);
template double distance_rounded_down<3>(std::span<const Point<3>>, std::span<const Point<3>>);

template <int D>
double distance_bound(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  const Filter<D> filter(a, b, 0);
  if (!filter.is_in_range()) return 0;
  const Relative_nearest<D> nearest = nearest_features<D>(a, b);
  const double bound = std::max({0.0, filter.gap(nearest.features), filter.gap(nearest.on_b - nearest.on_a)});
  return filter.is_tight(bound, nearest.distance) ? bound : distance_rounded_down<D>(a, b);
}

template double distance_bound<2>(std::span<const Point<2>>, std::span<const Point<2>>);
template double distance_bound<3>(std::span<const Point<3>>, std::span<const Point<3>>);

template <int D>
std::optional<Direction_at_distance<D>> direction_at_distance(std::span<const Point<D>> a,
                                                              std::span<const Point<D>> b, double r) {
  if (distance_bound<D>(a, b) > r) return {};
  const auto of_a = ring_corners<D>(a);
  const auto n = Ring_hulls<D>(of_a, b, r).find_direction_at_distance();
  if (!n) return {};
  Direction_at_distance<D> result{*n, 0};
  for (std::size_t i = 1; i < of_a.size(); ++i)
    if (CGAL::sign(product(*n, difference(of_a[i], of_a[result.corner]))) == CGAL::POSITIVE)
      result.corner = i;
  return result;
}

template std::optional<Direction_at_distance<2>> direction_at_distance(std::span<const Point<2>>,
                                                                       std::span<const Point<2>>, double);
template std::optional<Direction_at_distance<3>> direction_at_distance(std::span<const Point<3>>,
                                                                       std::span<const Point<3>>, double);

}  // namespace cellwalk::detail
