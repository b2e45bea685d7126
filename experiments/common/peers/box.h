// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes along the axes.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_BOX_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_BOX_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace cellwalk::experiments {

struct Box {
  Point<3> low, high;

  /// A box that holds nothing, and lies in nothing that is finite.
  static Box nowhere() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }
  bool contains(const Box& b) const {
    bool in = true;
    for (std::size_t k = 0; k < 3; ++k) {
      in &= low[k] <= b.low[k];
      in &= b.high[k] <= high[k];
    }
    return in;
  }
  Box enlarged(double margin) const {
    Box b = *this;
    for (std::size_t k = 0; k < 3; ++k) {
      b.low[k] -= margin;
      b.high[k] += margin;
    }
    return b;
  }
};

/// The box of a few points.
template <class... P>
inline Box box_of(const Point<3>& first, const P&... others) {
  Box b{first, first};
  for (const Point<3>* x : {&others...})
    for (std::size_t k = 0; k < 3; ++k) {
      b.low[k] = std::min(b.low[k], (*x)[k]);
      b.high[k] = std::max(b.high[k], (*x)[k]);
    }
  return b;
}

/// True if two closed boxes have a point in common.
inline bool meet(const Box& a, const Box& b) {
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k) {
    all &= a.low[k] <= b.high[k];
    all &= b.low[k] <= a.high[k];
  }
  return all;
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_BOX_H
