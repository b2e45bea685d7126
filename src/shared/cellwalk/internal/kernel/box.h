// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes along the axes. Internal.
#ifndef CELLWALK_INTERNAL_KERNEL_BOX_H
#define CELLWALK_INTERNAL_KERNEL_BOX_H

#include <cellwalk/internal/kernel/next_double.h>
#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace cellwalk::detail {

/// A point all of whose coordinates are x.
template <int D>
constexpr Point<D> with_all_coordinates(double x) {
  Point<D> p{};
  p.fill(x);
  return p;
}

/// A closed box along the axes; empty before it is extended.
template <int D>
struct Box {
  Point<D> low = with_all_coordinates<D>(std::numeric_limits<double>::infinity());
  Point<D> high = with_all_coordinates<D>(-std::numeric_limits<double>::infinity());

  /// True if the closed boxes have a point in common.
  bool meets(const Box& other) const {
    for (std::size_t k = 0; k < D; ++k)
      if (other.high[k] < low[k] || high[k] < other.low[k]) return false;
    return true;
  }
  /// True if the other box lies in it.
  bool contains(const Box& other) const {
    for (std::size_t k = 0; k < D; ++k)
      if (!(low[k] <= other.low[k] && other.high[k] <= high[k])) return false;
    return true;
  }
  void extend(const Point<D>& x) { extend(Box{x, x}); }
  void extend(const Box& other) {
    for (std::size_t k = 0; k < D; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
};

/// A box of all that is within a distance of one; the same box for the distance 0.
template <int D>
Box<D> enlarged(Box<D> box, double distance) {
  if (distance == 0) return box;
  for (std::size_t k = 0; k < D; ++k) {
    box.low[k] = next_below(box.low[k] - distance);
    box.high[k] = next_above(box.high[k] + distance);
  }
  return box;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_BOX_H
