// SPDX-License-Identifier: LGPL-3.0-or-later
// A box that grows by points: the inner loop of every method that keeps boxes.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_GROWING_BOX_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_GROWING_BOX_H

#include "box.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace cellwalk::experiments {

/// The box of the points added so far.
class Growing_box {
 public:
#ifdef __SSE2__
  explicit Growing_box(const Point<3>& p)
      : low_xy_(first(p)), low_yz_(last(p)), high_xy_(low_xy_), high_yz_(low_yz_) {}

  void add(const Point<3>& p) {
    const __m128d xy = first(p), yz = last(p);
    low_xy_ = _mm_min_pd(low_xy_, xy);
    low_yz_ = _mm_min_pd(low_yz_, yz);
    high_xy_ = _mm_max_pd(high_xy_, xy);
    high_yz_ = _mm_max_pd(high_yz_, yz);
  }
  Box box() const {
    Box b;
    store(b.low, low_xy_, low_yz_);
    store(b.high, high_xy_, high_yz_);
    return b;
  }

 private:
  static __m128d first(const Point<3>& p) { return _mm_loadu_pd(p.data()); }
  static __m128d last(const Point<3>& p) { return _mm_loadu_pd(p.data() + 1); }
  static void store(Point<3>& p, const __m128d& xy, const __m128d& yz) {
    _mm_storeu_pd(p.data(), xy);
    _mm_storeu_pd(p.data() + 1, yz);
  }

  __m128d low_xy_, low_yz_, high_xy_, high_yz_;
#else
  explicit Growing_box(const Point<3>& p) : box_{p, p} {}

  void add(const Point<3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      box_.low[k] = std::min(box_.low[k], p[k]);
      box_.high[k] = std::max(box_.high[k], p[k]);
    }
  }
  Box box() const { return box_; }

 private:
  Box box_;
#endif
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_GROWING_BOX_H
