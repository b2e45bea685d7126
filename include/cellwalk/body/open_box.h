// SPDX-License-Identifier: LGPL-3.0-or-later
// An open box with axis-parallel sides, and the question whether it holds many points, in lanes of two.
#ifndef CELLWALK_BODY_OPEN_BOX_H
#define CELLWALK_BODY_OPEN_BOX_H

#include <cellwalk/kernel/point.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cellwalk {

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
    bool is_inside = true;
    for (std::size_t k = 0; k < D; ++k) is_inside &= (low_[k] < x[k]) & (x[k] < high_[k]);
    return is_inside;
  }

  /// Cost: about 1 ns a point.
  bool holds_all(std::span<const Point<D>> points) const {
    const double* x = points.empty() ? nullptr : points.front().data();
    std::size_t left = points.size();
#if defined(__SSE2__)
    // Two points at a time: D pairs of coordinates.
    __m128d outside = _mm_setzero_pd();
    for (; left >= 2; left -= 2, x += lanes)
      for (std::size_t k = 0; k < lanes; k += 2) {
        const __m128d pair = _mm_loadu_pd(x + k);
        outside = _mm_or_pd(outside, _mm_cmpnlt_pd(_mm_load_pd(low_.data() + k), pair));
        outside = _mm_or_pd(outside, _mm_cmpnlt_pd(pair, _mm_load_pd(high_.data() + k)));
      }
    if (_mm_movemask_pd(outside) != 0) return false;
#endif
    bool is_inside = true;
    for (; left > 0; --left)
      for (std::size_t k = 0; k < D; ++k, ++x) is_inside &= (low_[k] < *x) & (*x < high_[k]);
    return is_inside;
  }

 private:
  static constexpr std::size_t lanes = 2 * D;  ///< each bound twice, as the coordinates of two points lie

  static std::array<double, lanes> twice(const Point<D>& x) {
    std::array<double, lanes> result;
    for (std::size_t k = 0; k < lanes; ++k) result[k] = x[k % D];
    return result;
  }

  alignas(16) std::array<double, lanes> low_, high_;
};

}  // namespace cellwalk

#endif  // CELLWALK_BODY_OPEN_BOX_H
