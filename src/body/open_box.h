// SPDX-License-Identifier: LGPL-3.0-or-later
// An open box with axis-parallel sides, and the question whether it holds many points, in lanes of two.
#ifndef CELLWALK_BODY_OPEN_BOX_H
#define CELLWALK_BODY_OPEN_BOX_H

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
    return all_true(both(between(0, first, first), between(D - 2, last, last)));
  }

  /// False if one of them is not finite.
  /// Cost: about half a nanosecond a point.
  bool holds_all(std::span<const Point<D>> points) const {
    if (points.size() % 2 != 0 && !holds(points.back())) return false;
    if (points.size() < 2) return true;
    // Two points at a time: D pairs of coordinates.
    const Pair_bounds<D> bounds(points.front().data(), points.size() / 2);
    Truth2 inside = between(0, bounds.low[0], bounds.high[0]);
    for (std::size_t k = 1; k < D; ++k) inside = both(inside, between(2 * k, bounds.low[k], bounds.high[k]));
    return all_true(both(inside, equal(bounds.sum, bounds.sum)));
  }

 private:
  static constexpr std::size_t lanes = 2 * D;  ///< each bound twice, as the coordinates of two points lie

  /// Whether two lanes from the given one on hold what lies from `low` to `high`.
  Truth2 between(std::size_t lane, Double2 low, Double2 high) const {
    return both(less(load(low_.data() + lane), low), less(high, load(high_.data() + lane)));
  }
  static std::array<double, lanes> twice(const Point<D>& x) {
    std::array<double, lanes> result;
    for (std::size_t k = 0; k < lanes; ++k) result[k] = x[k % D];
    return result;
  }

  alignas(16) std::array<double, lanes> low_, high_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_OPEN_BOX_H
