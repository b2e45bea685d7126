// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes rounded outward to floats, which are compared in a few instructions.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_FLOAT_BOX_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_FLOAT_BOX_H

#include <cmath>
#include <cstddef>
#include <limits>

#include "box.h"
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace cellwalk::experiments {

/// A box that holds a given one; the last lane is not used.
struct Float_box {
  alignas(16) float low[4];
  alignas(16) float high[4];

  explicit Float_box(const Box& b) : low{}, high{} {
    // Twice the largest error of rounding a number, and the least number for those that vanish.
    constexpr float relative = std::numeric_limits<float>::epsilon();
    constexpr float least = std::numeric_limits<float>::min();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto l = static_cast<float>(b.low[k]), h = static_cast<float>(b.high[k]);
      low[k] = l - (relative * std::fabs(l) + least);
      high[k] = h + (relative * std::fabs(h) + least);
    }
  }
};

/// True if two closed boxes have a point in common.
inline bool meet(const Float_box& a, const Float_box& b) {
#ifdef __SSE2__
  const __m128 apart = _mm_or_ps(_mm_cmpgt_ps(_mm_load_ps(a.low), _mm_load_ps(b.high)),
                                 _mm_cmpgt_ps(_mm_load_ps(b.low), _mm_load_ps(a.high)));
  return _mm_movemask_ps(apart) == 0;
#else
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k) {
    all &= a.low[k] <= b.high[k];
    all &= b.low[k] <= a.high[k];
  }
  return all;
#endif
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_FLOAT_BOX_H
