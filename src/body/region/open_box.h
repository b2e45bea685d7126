// SPDX-License-Identifier: LGPL-3.0-or-later
// An open box with axis-parallel sides, and the question whether it holds many points, in lanes of two.
#ifndef CELLWALK_BODY_REGION_OPEN_BOX_H
#define CELLWALK_BODY_REGION_OPEN_BOX_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "point_box.h"

namespace cellwalk::detail {

template <int D>
class Open_box {
 public:
  Open_box(const Point<D>& low, const Point<D>& high) : low_(twice(low)), high_(twice(high)) {}

  double low(int axis) const { return low_[static_cast<std::size_t>(axis)]; }
  double high(int axis) const { return high_[static_cast<std::size_t>(axis)]; }
  void cut_above(int axis, double value) {
    for (std::size_t k = static_cast<std::size_t>(axis); k < lanes; k += D)
      high_[k] = std::min(high_[k], value);
  }
  void cut_below(int axis, double value) {
    for (std::size_t k = static_cast<std::size_t>(axis); k < lanes; k += D)
      low_[k] = std::max(low_[k], value);
  }

  bool holds(const Point<D>& x) const {
    // In three dimensions the middle coordinate is in both pairs.
    const Double2 first = load(x.data()), last = load(x.data() + D - 2);
    return all_true(both(between(0, first, first), between(D - 1, last, last)));
  }

  /// False if one of them is not finite.
  /// Cost: about half a nanosecond a point.
  bool holds_all(std::span<const Point<D>> points) const {
    if (points.size() % 2 != 0) {
      if (!holds(points.back())) return false;
      points = points.first(points.size() - 1);
    }
    if (points.empty()) return true;
    // Two points at a time: D pairs of coordinates.
    const Pair_bounds<D> bounds(points);
    Truth2 inside = between(0, bounds.low[0], bounds.high[0]);
    for (std::size_t k = 1; k < D; ++k) inside = both(inside, between(k, bounds.low[k], bounds.high[k]));
    return all_true(both(inside, bounds.are_numbers()));
  }

 private:
  static constexpr std::size_t lanes = 2 * D;  ///< each bound twice, as the coordinates of two points lie

  /// Whether a pair of lanes holds all from `low` to `high`. The last holds the last two coordinates.
  Truth2 between(std::size_t pair, Double2 low, Double2 high) const {
    // A NaN fails the other comparison.
    return both(not_at_most(low, load_aligned(low_.data() + 2 * pair)),
                less(high, load_aligned(high_.data() + 2 * pair)));
  }
  static std::array<double, lanes> twice(const Point<D>& x) {
    std::array<double, lanes> result;
    for (std::size_t k = 0; k < lanes; ++k) result[k] = x[k % D];
    return result;
  }

  alignas(16) std::array<double, lanes> low_, high_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_OPEN_BOX_H
