// SPDX-License-Identifier: LGPL-3.0-or-later
// The box of many points.
#ifndef CELLWALK_BODY_POINT_BOX_H
#define CELLWALK_BODY_POINT_BOX_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace cellwalk::detail {

/// A closed box, and nothing before it is extended.
template <int D>
struct Box {
  Point<D> low, high;

  Box() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void extend(const Point<D>& x) {
    for (std::size_t k = 0; k < D; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  }
  void extend(const Box& other) {
    extend(other.low);
    extend(other.high);
  }
};

/// Two points at a time, as their coordinates lie: one minimum and one maximum for each of them.
template <int D>
Box<D> box_of(std::span<const Point<D>> points) {
  Box<D> box;
  if (points.empty()) return box;
  constexpr std::size_t lanes = 2 * D;
  std::array<double, lanes> low, high;
  for (std::size_t k = 0; k < lanes; ++k) low[k] = high[k] = points.front()[k % D];
  const double* x = points.front().data();
  for (std::size_t left = points.size() / 2; left > 0; --left, x += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      low[k] = x[k] < low[k] ? x[k] : low[k];
      high[k] = x[k] > high[k] ? x[k] : high[k];
    }
  for (std::size_t k = 0; k < D; ++k) {
    box.low[k] = std::min(low[k], low[k + D]);
    box.high[k] = std::max(high[k], high[k + D]);
  }
  if (points.size() % 2 != 0) box.extend(points.back());
  return box;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_POINT_BOX_H
